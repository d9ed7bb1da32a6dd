# The largest stable steps of viscous bridges, from the table of Tools/Studies/accuracy-versus-cost --viscous-stability.
#   gnuplot -c Tools/Studies/AccuracyVersusCost/viscous-stability.gp TABLE.CSV OUTPUT_WITHOUT_SUFFIX
if (ARGC < 2) exit error "give TABLE.CSV OUTPUT_WITHOUT_SUFFIX"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
set datafile commentschars "#"
table = ARG1
array schemes = ["gap", "gap for twelve neighbours", "implicit", "explicit", "explicit by velocity Verlet"]
array colours = ["#009E73", "#56B4E9", "#0072B2", "#D55E00", "#E69F00"]
place(bed) = bed eq "pair" ? 0 : bed eq "chain" ? 1 : bed eq "simple cubic" ? 2 : bed eq "random bed" ? 3 : 4
ofScheme(k) = sprintf("< awk -F, '$4 == \"%s\"' '%s'", schemes[k], table)
top = 200
shown(x) = x > top ? top : x  # bars up to the edge: no limit

set terminal pngcairo size 1200,760 fontscale 1.15 linewidth 1.4
set output ARG2.".png"
set style fill solid 0.85
set boxwidth 0.15
set logscale y
set yrange [0.15:top]
set xrange [-0.5:4.5]
set xtics ("pair" 0, "chain" 1, "simple cubic" 2, "random bed" 3, "face-centred cubic" 4)
set ylabel "largest c {/Symbol D}t / m* (bars to the edge: none)"
set key outside top center horizontal
plot for [k = 1:5] ofScheme(k) using (place(stringcolumn(1)) + 0.16 * (k - 3)):(shown(column(5))) with boxes linecolor rgb colours[k] title schemes[k], \
     for [k = 1:5] ofScheme(k) using (place(stringcolumn(1)) + 0.16 * (k - 3)):(column(6) > top ? NaN : column(6)) with points pointtype 2 pointsize 1.3 linecolor rgb "#000000" title (k == 1 ? "closed form" : ""), \
     ofScheme(1) using (place(stringcolumn(1))):(column(7) > top ? NaN : column(7)):(0.4) with xerrorbars pointtype 0 linewidth 2 linecolor rgb "#000000" title "advised, predicted velocities"
