# The largest cluster, and the grains that are alone, over the cohesion number, from runs of ShearedSuspension.
#   gnuplot -c Drivers/ShearedSuspension/plot.gp FOLDER    FOLDER/LAW/*/clusters.csv;
# writes FOLDER/clusters.png, and FOLDER/histogram.png of model-c
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
# Means over strains of at least 4 of a law's runs. Nothing is drawn at 0 on the axis of logarithms: 0.1 stands for it.
means(law) = system("for f in '".ARG1."/".law."'/*/clusters.csv; do [ -f \"$f\" ] && awk -F, 'NR > 1 && $2 > 3.999 { c = $3; a += $6; l += $8; n++ } END { print (c > 0 ? c : 0.1) \",\" l / n \",\" a / n }' \"$f\"; done | sort -g")
laws = "model-c model-c-near exact decay"
titles = "'model C, formed at touch' 'model C, without a touch' 'exact, 57 degrees' 'decay'"
array data[4]
do for [k = 1:4] { data[k] = means(word(laws, k)) }
set print $all
do for [k = 1:4] {
    print data[k]
    print ""
    print ""
}
# An independent program with the attraction of "decay" (README).
print "0.1,15.1,43.6\n0.55,33.2,17.5\n5.5,260,6.1"
unset print
set output ARG1."/clusters.png"
set multiplot layout 2, 1
set logscale x
set xtics ("0" 0.1, 0.5, 1, 2, 5, 10)
set xrange [0.08:13]
set key left top
set logscale y
set ylabel "largest cluster (grains)"
plot for [k = 1:4] $all index k - 1 using 1:2 with linespoints linewidth 2 pointtype 7 pointsize 1.4 linecolor k title word(titles, k), \
     $all index 4 using 1:2 with points pointtype 6 pointsize 3 linecolor rgb "black" title "independent program"
unset logscale y
unset key
set yrange [0:*]
set ylabel "alone (% of grains)"
set xlabel "cohesion number"
plot for [k = 1:4] $all index k - 1 using 1:3 with linespoints linewidth 2 pointtype 7 pointsize 1.4 linecolor k, \
     $all index 4 using 1:3 with points pointtype 6 pointsize 3 linecolor rgb "black"
unset multiplot

# Clusters by size, model C.
reset
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
runs = system("ls '".ARG1."/model-c' | sort -g")
set output ARG1."/histogram.png"
set logscale xy
set xrange [0.9:2000]
set yrange [0.005:2000]
set xlabel "grains in a cluster"
set ylabel "clusters, in the mean"
plot for [run in runs] ARG1."/model-c/".run."/histogram.csv" using 1:2 skip 1 with points pointtype 7 pointsize 0.9 title "cohesion number ".run
