# Bridges that are drawn out until they break: what stays on the better wetted sphere, and at which gap they break.
#   gnuplot -c Tools/Studies/LatticeBoltzmann/plot-parting.gp TABLE.CSV OUTPUT.PNG    TABLE.CSV: parting.csv
if (ARGC < 2) exit error "give TABLE.CSV OUTPUT.PNG"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
set output ARG2
set datafile commentschars "#"
# The rows at the end of a run, between equal spheres of which the second has this Delta rho.
ends(wetting) = abs(column("other_wetting") - wetting) < 1e-6 && abs(column("radius") - column("other_radius")) < 1e-6 && \
    strlen(stringcolumn("share")) > 0 && column("gap") > 0 ? capillary(column("speed")) : NaN
capillary(speed) = 0.73 / 6 * speed / 0.0497  # viscosity of the liquid x speed / tension
wettings = "0.1 0.08 0.05"
angles = "47 56 70"
set multiplot layout 1, 2
set logscale x
set xrange [0.008:0.2]
set xlabel "capillary number of the speed"
set ylabel "share of the liquid on the sphere of 47°"
set yrange [0:1.05]
set key bottom right
plot 0.5 with lines linestyle 4 title "half each, as liquid migrates", \
     for [k = 1:3] ARG1 using (ends(word(wettings, k) + 0)):"share" with points linestyle k title "other one ".word(angles, k)."°"
set ylabel "gap at which it breaks / radius"
set yrange [0:2.3]
plot for [k = 1:3] ARG1 using (ends(word(wettings, k) + 0)):"gap" with points linestyle k title "other one ".word(angles, k)."°"
unset multiplot
