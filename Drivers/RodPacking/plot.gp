# Solid fraction and neighbours of rods over their aspect ratio.
#   gnuplot -c Drivers/RodPacking/plot.gp FOLDER [ROUGH]    FOLDER: the driver's --output; writes FOLDER/packing.png
#   ROUGH: the folder of a run with another --friction
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
set output ARG1."/packing.png"
set xlabel "length / diameter of the rods"
set ylabel "solid fraction"
set y2label "neighbours of a rod"
set ytics nomirror
set y2tics
set yrange [0.5:0.75]
set y2range [0:15]
set key top right
plot ARG1."/packing.csv" using "aspect_ratio":"solid_fraction" with linespoints linestyle 1 title "solid fraction", \
     "" using "aspect_ratio":"neighbours_of_a_rod" axes x1y2 with linespoints linestyle 2 title "neighbours", \
     ARGC > 1 ? ARG2."/packing.csv" : NaN using "aspect_ratio":"solid_fraction" with linespoints linestyle 1 dashtype 2 \
         title (ARGC > 1 ? "solid fraction, with friction" : ""), \
     ARGC > 1 ? ARG2."/packing.csv" : NaN using "aspect_ratio":"neighbours_of_a_rod" axes x1y2 with linespoints \
         linestyle 2 dashtype 2 title (ARGC > 1 ? "neighbours, with friction" : "")
