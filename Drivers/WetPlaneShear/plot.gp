# Friction and solid fraction over the reduced pressure, means beyond a strain of 6.
#   gnuplot -c Drivers/WetPlaneShear/plot.gp FOLDER    FOLDER: has a folder for each run; writes FOLDER/shear.png
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
# P*, friction, its standard error (rows are 0.1 of strain apart; what is a strain apart is taken for independent), solid fraction
means = "< for f in ".ARG1."/*/shear.csv; do awk -F, 'NR > 1 && $2 > 6 { n++; p = $3; m += $4; q += $4 * $4; f += $6 } END { if (n > 10) { m /= n; print p \",\" m \",\" sqrt((q / n - m * m) / (n / 10)) \",\" f / n } }' $f; done | sort -t, -g"
set output ARG1."/shear.png"
set terminal pngcairo size 1100,800 fontscale 1.3 linewidth 1.5
set multiplot layout 2,1
set logscale x
set xrange [0.07:30]
set lmargin 10
set ylabel "friction {/Symbol t} / {/Symbol s}"
set yrange [0:*]
plot means using 1:2:3 with yerrorlines linestyle 1 notitle
set ylabel "solid fraction"
set yrange [*:*]
set xlabel "reduced pressure P* = P d / ({/Symbol p} {/Symbol g})"
plot means using 1:4 with linespoints linestyle 2 notitle
unset multiplot
