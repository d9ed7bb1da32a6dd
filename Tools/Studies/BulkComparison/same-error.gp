# What the same error takes, theirs over ours.   gnuplot -c same-error.gp same-error.csv CHART.png
if (ARGC < 2) exit error "give same-error.csv CHART.png"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
set datafile commentschars "#"
set terminal pngcairo size 1500,750 fontscale 1.0 linewidth 1.5
set output ARG2
# One place on the axis for each figure of a scene, three for its errors.
figures = system("awk -F, '!/^#/ && $1 != \"scene\" && !(($1 \" \" $2) in seen) { seen[$1 \" \" $2]; print $1 \":\" $2 }' ".ARG1)
place(name) = sum [k = 1:words(figures)] (word(figures, k) eq name ? k : 0)
array percents = [5, 2, 1]
array colours = ["#009E73", "#E69F00", "#D55E00"]
is(peer, e) = stringcolumn("peer") eq peer && column("error_percent") == percents[e]
x(peer, e) = is(peer, e) ? place(stringcolumn("scene").":".stringcolumn("figure")) + 0.2 * (e - 2) + (peer eq "lammps" ? 0.08 : 0) : NaN
set xtics rotate by -35 left nomirror
set for [k = 1:words(figures)] xtics add (system("echo '".word(figures, k)."' | sed 's/_deg$//; s/_m$//; s/_J$//; s/_s$//; s/_Pa$//; s/_kg.s$//; s/_/ /g; s/:/: /'") k)
set xrange [0.4:words(figures) + 0.6]
set yrange [0:8]
set ytics 1
set ylabel "time for the same error, theirs over ours"
set key top right
set bars small
plot 1 with lines dashtype 2 linecolor rgb "grey50" notitle, \
     for [e = 1:3] ARG1 using (x("liggghts", e)):"theirs_over_ours":"lowest":"highest" with yerrorbars pointtype 7 linecolor rgb colours[e] title sprintf("LIGGGHTS, %g %%", percents[e]), \
     for [e = 1:3] ARG1 using (x("lammps", e)):"theirs_over_ours":"lowest":"highest" with yerrorbars pointtype 6 linecolor rgb colours[e] title sprintf("LAMMPS, %g %%", percents[e])
