# The porosity of a column that is fluidised, and the drop of its pressure, over the speed of the water.
#   gnuplot -c Drivers/FluidisedColumn/plot.gp FOLDER    FOLDER: the driver's --output; writes FOLDER/column.png
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
column_table = ARG1."/column.csv"
set output ARG1."/column.png"
set multiplot layout 2, 1
set ylabel "porosity"
set key top left
plot column_table every 10::8 using "over_lift_off":"porosity" with points linestyle 2 title "near the end of a stage", \
     column_table using "over_lift_off":"porosity_of_the_law" with lines linestyle 1 title "drag is weight", \
     column_table using "over_lift_off":"porosity_richardson_zaki" with lines linestyle 4 title "Richardson and Zaki"
set xlabel "speed / that at lift-off"
set ylabel "pressure drop (Pa)"
set yrange [0:*]
set key bottom right
plot column_table every 10::8 using "over_lift_off":"pressure_drop_Pa" with points linestyle 2 title "by drag", \
     column_table using "over_lift_off":"weight_over_area_Pa" with lines linestyle 4 title "weight over area"
unset multiplot
