# Deviator stress and change of volume over the axial strain, in the sleeve and beside it in the periodic cell.
#   gnuplot -c Drivers/TriaxialSleeve/plot.gp SLEEVE PERIODIC    the stress.csv of both; writes sleeve.png beside SLEEVE
if (ARGC < 2) exit error "give SLEEVE and PERIODIC, the stress.csv of TriaxialSleeve and of TriaxialTest"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
test(file) = "< awk -F, 'NR > 1 && $2 == 1' '".file."'"
set output system("dirname '".ARG1."'")."/sleeve.png"
set multiplot layout 2, 1
set key bottom right
set ylabel "deviator stress, Pa"
set yrange [0:*]
plot test(ARG1) using 3:11 with lines linestyle 1 title "sleeve, on the platen", \
     test(ARG1) using 3:($6 - $7) with lines linestyle 3 title "sleeve, of the contacts", \
     test(ARG2) using 3:($6 - $7) with lines linestyle 2 title "periodic cell"
set xlabel "axial strain"
set ylabel "volumetric strain, %"
set yrange [*:*]
unset key
plot test(ARG1) using 3:(100 * $4) with lines linestyle 1, test(ARG2) using 3:(100 * $4) with lines linestyle 2
unset multiplot
