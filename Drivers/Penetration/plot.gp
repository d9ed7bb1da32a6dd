# The depth and the velocity of the intruder over time.
#   gnuplot -c Drivers/Penetration/plot.gp FOLDER    FOLDER: the driver's --output; writes FOLDER/depth.png
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"

set output ARG1."/depth.png"
set xlabel "time (ms)"
set ylabel "depth of the lowest point below the surface (mm)"
set y2label "velocity (m/s)"
set ytics nomirror
set y2tics
set key top left
depth = ARG1."/depth.csv"
plot depth using (1e3 * column("time_s")):(1e3 * column("depth_m")) with lines linestyle 1 title "depth", \
     depth using (1e3 * column("time_s")):"velocity_m/s" axes x1y2 with lines linestyle 2 title "velocity"
