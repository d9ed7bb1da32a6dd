# Friction angle, volume and contacts over the axial strain, from runs of TriaxialTest with several frictions.
#   gnuplot -c Drivers/TriaxialTest/plot.gp FOLDER    FOLDER/*/stress.csv; writes FOLDER/stress.png
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
runs = system("ls -d '".ARG1."'/*/")
name(run) = system("basename '".run."'")
test(file) = "< awk -F, 'NR > 1 && $2 == 1' '".file."stress.csv'"
set output ARG1."/stress.png"
set multiplot layout 2, 1
set key bottom right
set ylabel "friction angle, degrees"
set yrange [0:*]
plot for [k = 1:words(runs)] test(word(runs, k)) using 3:(asin($8) * 180 / pi) with lines linestyle k title "friction ".name(word(runs, k))
set xlabel "axial strain"
set ylabel "solid fraction"
set yrange [*:*]
unset key
plot for [k = 1:words(runs)] test(word(runs, k)) using 3:5 with lines linestyle k
unset multiplot
