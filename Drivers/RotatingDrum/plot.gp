# The numbers in the quarters of the drum over time, and a slice of the grains at the end.
#   gnuplot -c Drivers/RotatingDrum/plot.gp FOLDER    FOLDER: the driver's --output; writes FOLDER/{zones,grains}.png
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"

set output ARG1."/zones.png"
set xlabel "time (s)"
set ylabel "grains in the quarter"
set key outside top center horizontal
set yrange [0:*]
zones = ARG1."/zones.csv"
plot zones using "time_s":"M1_right_top" with lines linestyle 1 title "M1, right top", \
     zones using "time_s":"M1_left_bottom" with lines linestyle 2 title "M1, left bottom", \
     zones using "time_s":"M2_right_top" with lines linestyle 1 dashtype 3 title "M2, right top", \
     zones using "time_s":"M2_left_bottom" with lines linestyle 2 dashtype 3 title "M2, left bottom"

# Grains whose centres lie within 2 mm of the middle, as they are seen along y.
set output ARG1."/grains.png"
set terminal pngcairo size 900,900 fontscale 1.4 linewidth 1
set size ratio -1
set xlabel "x (mm)"
set ylabel "z (mm)"
set autoscale y
set style fill solid 0.8 border linecolor rgb "#333333"
grains = ARG1."/grains.csv"
inSlice(m) = abs(column("y_m")) < 2e-3 && strcol("material") eq m ? 1e3 * column("x_m") : NaN
plot grains using (inSlice("M1")):(1e3 * column("z_m")):(1e3 * column("radius_m")) \
         with circles linecolor rgb "#D55E00" title "M1", \
     grains using (inSlice("M2")):(1e3 * column("z_m")):(1e3 * column("radius_m")) \
         with circles linecolor rgb "#56B4E9" title "M2"
