# Accuracy of the liquid bridge laws against their cost, from the table of Tools/Studies/accuracy-versus-cost --bridges.
#   gnuplot -c bridges.gp TABLE.csv OUTPUT_WITHOUT_SUFFIX
# OUTPUT.png: the population "wide", against the time of the force and of the preparation; OUTPUT-populations.png: all.
if (ARGC < 2) exit error "give TABLE.csv OUTPUT_WITHOUT_SUFFIX"

set datafile separator comma
set encoding utf8
set grid linecolor rgb "#dddddd"
set logscale xy
set format y "10^{%L}"
unset key
set ylabel "95th percentile of the error of {/:Italic F} (%)" offset 1,0
set yrange [0.005:20000]

# Rows of a population: x, y, name, on the front, and a height for the label. Labels stand at even distances, in the order
# of the errors, so that they do not overlap.
rows(population, cost, front) = sprintf("< awk -F, -v population='%s' -v cost=%s -v front=%s '\
    /^#/ { next } \
    !header { header = 1; for (i = 1; i <= NF; ++i) column[$i] = i; next } \
    $column[\"population\"] == population && $column[\"force_percentile95_percent\"] != \"\" { \
        name = $1; sub(\"LiquidBridge\", \"\", name); \
        print $column[cost] \",\" $column[\"force_percentile95_percent\"] \",\" name \",\" $column[front] }' '%s' \
    | sort -t, -k2g | awk -F, '{ line[NR] = $0 } \
        END { for (k = 1; k <= NR; ++k) print line[k] \",\" 0.012 * exp((k - 1) / (NR > 13 ? NR - 1 : 12) * log(9000 / 0.012)) }'", \
    population, cost, front, ARG1)

frontRows(population, cost, front) = rows(population, cost, front)." | awk -F, '$4 == 1' | sort -t, -k1g"

# Colours of Okabe and Ito, which colour-blind readers tell apart. `labels` is the x of the labels.
panel = "plot \
    rows(population, cost, front) using 1:2:(labels - $1):($5 - $2) with vectors nohead linewidth 0.7 linecolor rgb '#bbbbbb', \
    frontRows(population, cost, front) using 1:2 with steps linewidth 2 linecolor rgb '#D55E00', \
    rows(population, cost, front) using 1:($4 == 0 ? $2 : NaN) with points pointtype 7 pointsize 1.2 linecolor rgb '#0072B2', \
    '' using 1:($4 == 1 ? $2 : NaN) with points pointtype 7 pointsize 1.5 linecolor rgb '#D55E00', \
    '' using (labels * 1.05):5:3:($4 == 1 ? 0xD55E00 : 0x000000) with labels left textcolor rgb variable"

set terminal pngcairo size 1300,680 fontscale 1 linewidth 1.5
set output ARG2.".png"
set multiplot layout 1,2 title "Liquid bridge laws: accuracy against cost; orange: the Pareto front"
population = "wide"
cost = "force_ns_per_bridge"
front = "front_of_force"
labels = 8
set xrange [0.4:40]
set xtics (0.5, 1, 2, 4)
set xlabel "time of the force of one bridge, eight at once (ns)"
@panel
cost = "prepare_ns_per_bridge"
front = "front_of_prepare"
labels = 3e5
set xrange [8:2e7]
set xtics (10, 100, "10^3" 1000, "10^4" 1e4, "10^5" 1e5)
set xlabel "time to prepare one bridge (ns)"
@panel
unset multiplot

set terminal pngcairo size 1500,1080 fontscale 0.92 linewidth 1.3
set output ARG2."-populations.png"
set multiplot layout 2,3
cost = "force_ns_per_bridge"
front = "front_of_force"
labels = 8
set xrange [0.4:50]
set xtics (0.5, 1, 2, 4)
set xlabel "time of the force of one bridge, eight at once (ns)"
do for [name in "'equal spheres' 'polydisperse 1:4' 'sphere on wall' 'partial wetting' 'large volumes' 'wide'"] {
    population = name
    set title name
    @panel
}
unset multiplot
