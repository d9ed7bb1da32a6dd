# The stability limit that is given over the critical step that was measured, for each law, damping and scene.
#   gnuplot -c Tools/Studies/AccuracyVersusCost/critical-steps.gp CRITICAL-STEPS.CSV OUTPUT_WITHOUT_SUFFIX
if (ARGC < 2) exit error "give CRITICAL-STEPS.CSV OUTPUT_WITHOUT_SUFFIX"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
table = ARG1
set datafile commentschars "#"
set terminal pngcairo size 1500,620 fontscale 1.05 linewidth 1.5
set output ARG2.".png"

of(scene, integrator, name) = stringcolumn("scene") eq scene && stringcolumn("integrator") eq integrator ? column(name) : NaN
array scenes = ["densest bed", "small between large", "pair", "at a wall", "large covered by small"]
array colours = ["#D55E00", "#0072B2", "#009E73", "#CC79A7", "#E69F00"]
array marks = [7, 5, 9, 11, 13]
# Dampings side by side; the scenes a little apart.
place(zeta, k) = (zeta == 0 ? 0 : zeta < 0.1 ? 1 : zeta < 0.3 ? 2 : zeta < 0.8 ? 3 : zeta < 2 ? 4 : 5) + 0.15 * (k - 3)

set xrange [-0.5:5.5]
set xtics ("0" 0, "0.05" 1, "0.2" 2, "0.6" 3, "1" 4, "3" 5)
set xlabel "damping ratio of the dashpots"
set yrange [0:120]
set format y "%g %%"
unset key
set multiplot layout 1,3
do for [integrator in "PredictedVelocityVerlet VelocityVerlet AdamsMoulton"] {
    set title integrator
    set ylabel (integrator eq "PredictedVelocityVerlet" ? "advice over critical step" : "")
    if (integrator eq "AdamsMoulton") { set key top right }
    set arrow 1 from -0.5,100 to 5.5,100 nohead linewidth 1 linecolor rgb "#000000"
    set arrow 2 from -0.5,40 to 5.5,40 nohead linewidth 1 dashtype 2 linecolor rgb "#000000"
    plot for [k = 1:5] table using (place(column("damping_ratio"), k)):(of(scenes[k], integrator, "advised_over_critical_percent")) \
             with points pointtype marks[k] pointsize 1.1 linecolor rgb colours[k] title scenes[k]
}
unset multiplot
