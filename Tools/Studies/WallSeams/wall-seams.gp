# The force on a grain over a slit between two plates, and in the corner of a step.
#   gnuplot -c Tools/Studies/WallSeams/wall-seams.gp SEAMS.CSV OUTPUT_WITHOUT_SUFFIX
# SEAMS.CSV: what `wall-seams` prints.
if (ARGC < 2) exit error "give SEAMS.CSV OUTPUT_WITHOUT_SUFFIX"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
table = ARG1
set datafile missing NaN
set terminal pngcairo size 1100,460 fontscale 1.05 linewidth 1.5
set output ARG2.".png"
of(wanted) = stringcolumn("case") eq wanted ? column("force_of_hertz") : NaN
set multiplot layout 1,2
set xrange [0:3]
set yrange [0:2.1]
set ylabel "force / that of one contact"
set key bottom left reverse Left
set xlabel "width of the slit / radius of Hertz' contact"
plot table using "size":(of("slit_middle")) with lines linestyle 1 title "over its middle", \
     table using "size":(of("slit_edge")) with lines linestyle 2 title "over the edge of a plate"
unset ylabel
set xlabel "height of the step / overlap"
set key bottom right noreverse Right
plot table using "size":(of("step")) with lines linestyle 1 title "in its corner"
unset multiplot
