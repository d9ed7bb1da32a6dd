# What jets wear off plates over their angle, in units of c m v^2 / p, with Finnie's curve.
#   gnuplot -c Drivers/WornPlates/plot.gp FOLDER [DENSE]    FOLDER: the driver's --output; writes FOLDER/wear.png
#   DENSE: the folder of a run with another --spacing
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
set output ARG1."/wear.png"
set xlabel "angle between jet and plate (degrees)"
set ylabel "V p / (c m v^2)"
set xrange [0:90]
set yrange [0:0.35]
finnie(a) = 3 * tan(a * pi / 180) < 1 ? sin(a * pi / 90) - 3 * sin(a * pi / 180)**2 : cos(a * pi / 180)**2 / 3
set samples 500
if (ARGC > 1) {
    plot finnie(x) with lines linestyle 4 title "Finnie", \
         ARG1."/worn.csv" using "angle_deg":"factor" with points linestyle 1 title "thin jets", \
         ARG2."/worn.csv" using "angle_deg":"factor" with points linestyle 2 title "dense jets"
} else {
    plot finnie(x) with lines linestyle 4 title "Finnie", \
         ARG1."/worn.csv" using "angle_deg":"factor" with points linestyle 1 title "jets"
}
