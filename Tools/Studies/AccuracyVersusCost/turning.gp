# The angle by which a free body errs after 20 s over the cost of a turn, for four schemes.
#   gnuplot -c Tools/Studies/AccuracyVersusCost/turning.gp TURNING.CSV OUTPUT_WITHOUT_SUFFIX
if (ARGC < 2) exit error "give TURNING.CSV OUTPUT_WITHOUT_SUFFIX"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
table = ARG1
set terminal pngcairo size 900,620 fontscale 1.05 linewidth 1.5
set output ARG2.".png"
array names = ["splitting", "midpoint", "Richardson", "Runge-Kutta"]
array titles = ["splitting of the axes (taken)", "explicit midpoint", "Richardson (LAMMPS)", "Runge-Kutta 4"]
of(scheme, name) = stringcolumn("scheme") eq scheme ? column(name) : NaN
set logscale xy
set format y "10^{%L}"
set xlabel "time for a turn of one body, of eight at once, ns"
set ylabel "angle off after 20 s, rad"
set key bottom left
plot for [k = 1:4] table using (of(names[k], "ns_per_turn")):(of(names[k], "angle_error_rad")) \
         with linespoints linestyle k pointtype 7 pointsize 0.8 title titles[k]
