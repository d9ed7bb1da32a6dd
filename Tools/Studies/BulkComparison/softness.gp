# Deviations of bulk figures over the time of the processor, for softer and softer grains.   gnuplot -c softness.gp softness.csv CHART.png
if (ARGC < 2) exit error "give softness.csv CHART.png"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
set datafile commentschars "#"
set terminal pngcairo size 1700,1150 fontscale 1.0 linewidth 1.5
set output ARG2
array codes = ["pendular-adaptive", "pendular-for-error", "liggghts", "pendular-50-steps", "pendular-20-steps"]
array titles = ["adaptive step", "setStepFor(0.01)", "LIGGGHTS", "50 steps a contact", "20 steps a contact"]
array colours = ["#E69F00", "#D55E00", "#009E73", "#0072B2", "#0072B2"]
lowest = 0.1
low(x) = x > lowest ? x : lowest
is(k, scene, figure) = stringcolumn("scene") eq scene && stringcolumn("figure") eq figure && stringcolumn("code") eq codes[k] && \
    abs(column("deviation_percent")) > 0
cost(k, scene, figure) = is(k, scene, figure) ? column("processor_s") : NaN
size = "deviation_percent"
error = "deviation_standard_error_percent"
scatter(x) = x > 0 ? x : 0  # none of one start
set logscale xy
set format y "%g %%"
set yrange [lowest:100]
set ylabel "deviation from the hardest"
set multiplot layout 2,3
do for [panel in "'bed solid_fraction' 'bed coordination' 'drum centre_angle_deg' 'hopper flow_kg/s' 'shear friction' 'wet-shear friction'"] {
    scene = word(panel, 1)
    figure = word(panel, 2)
    # Of a table without the figure the panel stays empty.
    if (system("grep -c '^".scene.",.*,".figure.",' ".ARG1) eq "0") { set multiplot next; continue }
    set title scene.": ".system("echo ".figure." | sed 's/_deg//; s/_kg.s//; s/_/ /g'")
    if (scene[strlen(scene) - 4:] eq "shear") { set xrange [0.02:20] } else { set xrange [0.3:300] }
    if (panel eq "bed solid_fraction" || panel eq "shear friction") { set key top right samplen 1 opaque } else { set key off }
    set xlabel scene[strlen(scene) - 4:] eq "shear" ? "s of the processor for a strain of 1" : "s of the processor for a second of the scene"
    plot for [k = 1:5] ARG1 using (cost(k, scene, figure)):(low(abs(column(size)))):(low(abs(column(size)) - scatter(column(error)))):(low(abs(column(size)) + scatter(column(error)))) \
             with yerrorbars linewidth 1.5 pointtype 7 pointsize 1.2 linecolor rgb colours[k] title titles[k], \
         for [k = 1:5] ARG1 using (cost(k, scene, figure)):(low(abs(column(size)))):("  ".strcol("modulus_Pa_or_stiffness")) \
             with labels left font ",10" textcolor rgb colours[k] notitle
}
unset multiplot
