# The pressure on the wall of a silo over depth, and Janssen's law.
#   gnuplot -c Drivers/SiloFilling/plot.gp FOLDER    FOLDER: the driver's --output; writes FOLDER/pressure.png
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
table = ARG1."/pressure.csv"

set output ARG1."/pressure.png"
set xlabel "depth (mm)"
set ylabel "pressure on the wall (Pa)"
set xrange [0:*]
set key top left
stats table using "wall_pressure_Pa" nooutput
set yrange [0:1.5 * STATS_max]
plot table using (1e3 * column("depth_m")):"wall_pressure_Pa" with points linestyle 1 title "grains on the wall", \
     table using (1e3 * column("depth_m")):"wall_shear_Pa" with points linestyle 3 title "their friction", \
     table using (1e3 * column("depth_m")):"janssen_Pa" with lines linestyle 2 title "Janssen", \
     table using (1e3 * column("depth_m")):"hydrostatic_Pa" with lines linestyle 4 title "without friction of the wall"
