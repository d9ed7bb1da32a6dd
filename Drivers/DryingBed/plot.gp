# The capillary tension of a bed that dries, its bridges and its liquid, over time.
#   gnuplot -c Drivers/DryingBed/plot.gp FOLDER    FOLDER: the driver's --output; writes FOLDER/drying.png
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
drying = ARG1."/drying.csv"

set output ARG1."/drying.png"
set multiplot layout 2, 1
set ylabel "capillary tension (Pa)"
set yrange [0:*]
set key bottom left
plot drying using "time_s":"tension_Pa" with lines linestyle 1 title "in the bed", \
     drying using "time_s":"rumpf_Pa" with lines linestyle 4 title "Rumpf, with its bridges"
set xlabel "time (s)"
set ylabel "bridges of a grain"
set y2label "liquid (% of the start)"
set ytics nomirror
set y2tics
set y2range [0:*]
set key top right
stats drying using (column("films_m3") + column("bridges_m3")) nooutput
plot drying using "time_s":"bridges_of_a_grain" with lines linestyle 2 title "bridges", \
     drying using "time_s":(100 * (column("films_m3") + column("bridges_m3")) / STATS_max) axes x1y2 with lines linestyle 3 title "liquid"
unset multiplot
