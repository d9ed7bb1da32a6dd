# Errors of collisions over cost, for each integrator.
#   gnuplot -c Tools/Studies/AccuracyVersusCost/time-chart.gp TIME.CSV OUTPUT_WITHOUT_SUFFIX
if (ARGC < 2) exit error "give TIME.CSV OUTPUT_WITHOUT_SUFFIX"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
table = ARG1
set datafile commentschars "#"
set terminal pngcairo size 1900,1100 fontscale 1.1 linewidth 1.5
set output ARG2.".png"

of(collision, integrator, name) = stringcolumn("collision") eq collision && stringcolumn("integrator") eq integrator ? column(name) : NaN
array names = ["VelocityVerlet", "PredictedVelocityVerlet", "AdamsMoulton"]
array titles = ["velocity Verlet, as in other codes", "predicted velocity Verlet (default)", "Adams-Moulton, third order"]

set logscale xy
set format y "%g %%"
set xrange [4:700]
set yrange [1e-4:20]
set xlabel "cost of a contact (steps of the default)"
set key bottom left
set multiplot layout 2,3
do for [panel in "linear Hertz oblique wet JKR"] {
    what = panel eq "oblique" ? "spin_error_percent" : "parting_error_percent"
    set ylabel (panel eq "oblique" ? "error of spin" : "error of rebound")
    set title (panel eq "linear" ? "linear, e = 0.5" : panel eq "Hertz" ? "Hertz, e = 0.5" : \
               panel eq "oblique" ? "Hertz-Mindlin at 15 degrees, e = 0.9" : \
               panel eq "wet" ? "Hertz with a liquid bridge, e = 0.9" : "Hertz with JKR's adhesion, e = 0.9")
    plot for [k = 1:3] table using (of(panel, names[k], "cost_in_default_steps")):(of(panel, names[k], what)) \
             with linespoints linestyle k pointtype 7 pointsize 0.8 title titles[k]
}
unset multiplot
