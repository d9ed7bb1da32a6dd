# Deviations of bulk figures over the time of the processor, for each code and step.   gnuplot -c bulk.gp TABLE.csv CHART.png
if (ARGC < 2) exit error "give TABLE.csv CHART.png"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
set datafile commentschars "#"
set terminal pngcairo size 2200,1150 fontscale 1.0 linewidth 1.5
set output ARG2
array codes = ["pendular-default", "pendular-velocity-verlet", "pendular-adaptive", "liggghts", "lammps"]
array titles = ["Pendular, default", "Pendular, velocity Verlet", "Pendular, adaptive step", "LIGGGHTS", "LAMMPS"]
array colours = ["#D55E00", "#0072B2", "#E69F00", "#009E73", "#CC79A7"]
lowest = 0.1
low(x) = x > lowest ? x : lowest
is(k, scene, figure) = stringcolumn("scene") eq scene && stringcolumn("figure") eq figure && stringcolumn("code") eq codes[k] && \
    abs(column("deviation_percent")) > 0
cost(k, scene, figure) = is(k, scene, figure) ? column("processor_s_per_s") : NaN
size = "deviation_percent"
error = "deviation_standard_error_percent"
scatter(x) = x > 0 ? x : 0  # none of one seed
set logscale xy
set format y "%g %%"
set yrange [lowest:100]
set xlabel "s of the processor for a second of the scene"
set ylabel "deviation from the smallest step"
set key off
set multiplot layout 2,4
do for [panel in "'bed coordination' 'bed solid_fraction' 'drum centre_angle_deg' 'drum coordination' 'hopper flow_kg/s' 'silo flow_kg/s' 'impact depth_m' 'impact kinetic_energy_J'"] {
    scene = word(panel, 1)
    figure = word(panel, 2)
    # Of a table without the figure the panel stays empty.
    if (system("grep -c '^".scene.",.*,".figure.",' ".ARG1) eq "0") { set multiplot next; continue }
    set title scene.": ".system("echo ".figure." | sed 's/_deg//; s/_m$//; s/_J$//; s/_kg.s//; s/_/ /g'")
    if (panel eq "bed coordination") { set key top right samplen 1 opaque } else { set key off }
    plot for [k = 1:5] ARG1 using (cost(k, scene, figure)):(low(abs(column(size)))):(low(abs(column(size)) - scatter(column(error)))):(low(abs(column(size)) + scatter(column(error)))) \
             with yerrorbars linewidth 1.5 pointtype 7 pointsize 1.2 linecolor rgb colours[k] title titles[k], \
         for [k = 1:5] ARG1 using (cost(k, scene, figure)):(low(abs(column(size)))):(sprintf("  %g", column("step_over_rayleigh_time_or_share"))) \
             with labels left font ",10" textcolor rgb colours[k] notitle
}
unset multiplot
