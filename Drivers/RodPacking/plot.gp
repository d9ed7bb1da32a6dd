# Solid fraction and contacts of rods over their aspect ratio, with the maximum of Williams and Philipse.
#   gnuplot -c Drivers/RodPacking/plot.gp FOLDER [ROUGH]    FOLDER: the driver's --output; writes FOLDER/packing.png
#   ROUGH: the folder of a run with --friction
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
set output ARG1."/packing.png"
set xlabel "length / diameter of the rods"
set ylabel "solid fraction"
set y2label "contacts of a rod"
set ytics nomirror
set y2tics
set yrange [0.5:0.75]
set y2range [0:15]
set key top right
set style line 5 linecolor rgb "#000000" pointtype 2 pointsize 2 linewidth 2
$Maximum << EOD
1.4,0.695
EOD
smooth = ARG1."/packing.csv"
if (ARGC > 1) {
    rough = ARG2."/packing.csv"
    plot smooth using "aspect_ratio":"solid_fraction" with linespoints linestyle 1 title "solid fraction", \
         smooth using "aspect_ratio":"contacts_of_a_rod" axes x1y2 with linespoints linestyle 2 title "contacts", \
         rough using "aspect_ratio":"solid_fraction" with linespoints linestyle 1 dashtype 2 title "solid fraction, with friction", \
         rough using "aspect_ratio":"contacts_of_a_rod" axes x1y2 with linespoints linestyle 2 dashtype 2 title "contacts, with friction", \
         $Maximum using 1:2 with points linestyle 5 title "Williams and Philipse, maximum"
} else {
    plot smooth using "aspect_ratio":"solid_fraction" with linespoints linestyle 1 title "solid fraction", \
         smooth using "aspect_ratio":"contacts_of_a_rod" axes x1y2 with linespoints linestyle 2 title "contacts", \
         $Maximum using 1:2 with points linestyle 5 title "Williams and Philipse, maximum"
}
