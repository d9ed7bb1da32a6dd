# Deviations of bulk figures over cost, for each law and step; bars are the standard errors of seeds and time.
#   gnuplot -c Tools/Studies/AccuracyVersusCost/bulk-chart.gp BULK.CSV OUTPUT_WITHOUT_SUFFIX
if (ARGC < 2) exit error "give BULK.CSV OUTPUT_WITHOUT_SUFFIX"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
table = ARG1
set datafile commentschars "#"
set terminal pngcairo size 1700,1150 fontscale 1.0 linewidth 1.5
set output ARG2.".png"

# Young's modulus of the reference is the first.
reference(scene) = real(system("awk -F, -v scene=".scene." '$1 == scene { printf \"%.0f\", $3; exit }' '".table."'"))
array laws = ["Hertz-Mindlin", "Hertz-Mindlin", "Hertz-Mindlin", "linear", "Hertz without friction", "linear without friction"]
array softening = [1, 10, 100, 1, 1, 1]
array titles = ["Hertz-Mindlin", "the same, modulus / 10", "the same, modulus / 100", "linear with friction", "Hertz without friction", "linear without friction"]
array colours = ["#000000", "#D55E00", "#E69F00", "#0072B2", "#009E73", "#CC79A7"]
is(k, scene, figure) = stringcolumn("scene") eq scene && stringcolumn("figure") eq figure && stringcolumn("law") eq laws[k] && \
    abs(column("elastic_modulus_Pa") * softening[k] / modulus - 1) < 1e-6 && column("deviation_standard_error_percent") > 0
cost(k, scene, figure) = is(k, scene, figure) ? column("time_of_simulated_second_over_reference") : NaN
size = "deviation_percent"
error = "deviation_standard_error_percent"
lowest = 0.05
low(x) = x > lowest ? x : lowest

set logscale xy
set format y "%g %%"
set xrange [0.03:1.3]
set yrange [lowest:2000]
set xlabel "time of the processor / reference"
set ylabel "deviation"
set key off
set multiplot layout 2,3
do for [panel in "'bed coordination' 'bed solid_fraction' 'bed horizontal_over_vertical_stress' 'drum surface_angle_deg' 'drum centre_angle_deg' 'drum coordination'"] {
    scene = word(panel, 1)
    figure = word(panel, 2)
    modulus = reference(scene)
    set title scene.": ".system("echo ".figure." | sed 's/_deg//; s/_/ /g'")
    if (figure eq "coordination" && scene eq "bed") { set key top left samplen 1 opaque } else { set key off }
    plot 1 with lines linewidth 1 dashtype 3 linecolor rgb "#777777" notitle, \
         for [k = 1:6] table using (cost(k, scene, figure)):(low(abs(column(size)))):(low(abs(column(size)) - column(error))):(low(abs(column(size)) + column(error))) \
             with yerrorbars linewidth 1.5 pointtype 7 pointsize 1.2 linecolor rgb colours[k] title titles[k], \
         for [k = 1:6] table using (cost(k, scene, figure)):(low(abs(column(size)))):(sprintf("  %.1f", column("step_times_omega"))) \
             with labels left font ",10" textcolor rgb colours[k] notitle
}
unset multiplot
