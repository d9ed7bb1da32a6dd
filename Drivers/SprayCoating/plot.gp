# How evenly the liquid of a spray lies on the grains of a drum, and how many are dry, against ideal mixing.
#   gnuplot -c Drivers/SprayCoating/plot.gp FOLDER    FOLDER: the driver's --output; writes FOLDER/coating.png
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
coating = ARG1."/coating.csv"

set output ARG1."/coating.png"
set multiplot layout 2, 1
set logscale y
set ylabel "coefficient of variation"
plot coating using "time_s":"variation" with lines linestyle 1 title "liquid of the grains", \
     coating using "time_s":"variation_if_mixed" with lines linestyle 4 title "ideal mixer"
set xlabel "time (s)"
set ylabel "share of dry grains"
set yrange [1e-3:1]
plot coating using "time_s":"dry_share" with lines linestyle 2 title "dry grains", \
     coating using "time_s":"dry_share_if_mixed" with lines linestyle 4 title "ideal mixer"
unset multiplot
