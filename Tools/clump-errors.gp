# How far clumps are from the mesh that they fill, over the number of spheres.
#   gnuplot -c Tools/clump-errors.gp ERRORS.CSV OUTPUT_WITHOUT_SUFFIX
# ERRORS.CSV: what `clump --errors` writes, or several of these behind each other.
if (ARGC < 2) exit error "give ERRORS.CSV OUTPUT_WITHOUT_SUFFIX"
load system("dirname '".ARG0."'")."/../Drivers/Shared/chart.gp"
table = ARG1
set terminal pngcairo size 1500,520 fontscale 1.05 linewidth 1.5
set output ARG2.".png"
of(method, name) = stringcolumn("method") eq method ? abs(column(name)) * 100 : NaN
set logscale xy
set xrange [0.8:100]
set yrange [0.5:100]
set format y "%g %%"
set xlabel "spheres"
set key bottom left
set multiplot layout 1,3
do for [what in "volume inertia surface"] {
    set title "error of the ".(what eq "inertia" ? "worst principal moment" : what)
    plot table using "spheres":(of("surface", what."_error")) with linespoints linestyle 1 pointtype 7 \
             title "grown from the surface", \
         table using "spheres":(of("within", what."_error")) with linespoints linestyle 2 pointtype 5 \
             title "in the deepest places"
}
unset multiplot
