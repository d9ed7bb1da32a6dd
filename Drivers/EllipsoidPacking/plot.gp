# Solid fraction and contacts of ellipsoids over their aspect ratio, with what Donev et al. give for 1.9.
#   gnuplot -c Drivers/EllipsoidPacking/plot.gp FOLDER [SHARP]    FOLDER: the driver's --output; writes FOLDER/packing.png
#   SHARP: the folder of a run with --exponent 4
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
set output ARG1."/packing.png"
set xlabel "length along the axis / across it"
set ylabel "solid fraction"
set y2label "contacts of a grain"
set ytics nomirror
set y2tics
set logscale x
set xrange [0.4:3]
set xtics (0.5, 0.7, 1, 1.5, 2, 3)
set yrange [0.55:0.8]
set y2range [0:15]
set key top right
set style line 5 linecolor rgb "#000000" pointtype 2 pointsize 2 linewidth 2
$Random << EOD
1.9,0.695,0.68,0.71
EOD
smooth = ARG1."/packing.csv"
if (ARGC > 1) {
    sharp = ARG2."/packing.csv"
    plot smooth using "aspect_ratio":"solid_fraction" with linespoints linestyle 1 title "solid fraction", \
         smooth using "aspect_ratio":"contacts_of_a_grain" axes x1y2 with linespoints linestyle 2 title "contacts", \
         sharp using "aspect_ratio":"solid_fraction" with linespoints linestyle 1 dashtype 2 title "solid fraction, exponent 4", \
         sharp using "aspect_ratio":"contacts_of_a_grain" axes x1y2 with linespoints linestyle 2 dashtype 2 title "contacts, exponent 4", \
         $Random using 1:2:3:4 with yerrorbars linestyle 5 title "Donev et al., random packings"
} else {
    plot smooth using "aspect_ratio":"solid_fraction" with linespoints linestyle 1 title "solid fraction", \
         smooth using "aspect_ratio":"contacts_of_a_grain" axes x1y2 with linespoints linestyle 2 title "contacts", \
         $Random using 1:2:3:4 with yerrorbars linestyle 5 title "Donev et al., random packings"
}
