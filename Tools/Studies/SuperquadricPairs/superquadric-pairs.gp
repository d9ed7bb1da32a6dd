# Where Newton's method fails for pairs of superquadrics, how far depths are off, and what a pair takes.
#   gnuplot -c Tools/Studies/SuperquadricPairs/superquadric-pairs.gp PAIRS.CSV OUTPUT_WITHOUT_SUFFIX
# PAIRS.CSV: what `superquadric-pairs` prints.
if (ARGC < 2) exit error "give PAIRS.CSV OUTPUT_WITHOUT_SUFFIX"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
table = ARG1
set datafile missing NaN
set terminal pngcairo size 1500,520 fontscale 1.05 linewidth 1.5
set output ARG2.".png"
ratio = "largest_ratio_of_half_lengths"
of(wanted, value) = column(ratio) == wanted ? value : NaN
set xlabel "exponent"
set xrange [1.5:8.5]
set key top left reverse Left
set multiplot layout 1,3
set title "Newton's method has not ended"
set format y "%g %%"
set yrange [0:5]
plot for [k=0:3] r = word("1 2 5 10", k + 1) + 0 \
    table using "exponent":(of(r, 100.0 * column("failures_of_newton") / column("pairs"))) \
    with linespoints linestyle (k + 1) pointtype (5 + 2 * k) title sprintf("half lengths up to 1 : %g", r)
set title "largest difference of the depth from two starts"
set logscale y
set yrange [1e-17:1e-6]
set format y "10^{%T}"
plot for [k=0:3] r = word("1 2 5 10", k + 1) + 0 \
    table using "exponent":(of(r, column("largest_difference_of_depth_per_distance") + 1e-17)) \
    with linespoints linestyle (k + 1) pointtype (5 + 2 * k) notitle
set title "time of a pair that touches (ns)"
unset logscale y
set yrange [1e-17:1e-6]
set format y "%g"
set yrange [0:*]
set key spacing 1.2
plot table using "exponent":(of(2, column("cold_time_ns"))) with linespoints linestyle 1 title "first normal", \
     table using "exponent":(of(2, column("warm_time_ns"))) with linespoints linestyle 2 title "normal of the last step"
unset multiplot
