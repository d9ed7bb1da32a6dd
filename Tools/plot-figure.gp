# The capillary force over the separation, on the way out of a collision, for three models of the bridge.
#   gnuplot -c plot-figure.gp DATA_FOLDER TITLE OUTPUT_WITHOUT_SUFFIX
# DATA_FOLDER holds a folder for each model, with force_separation.csv (attraction negative there, positive in the chart).
if (ARGC < 3) exit error "give DATA_FOLDER TITLE OUTPUT_WITHOUT_SUFFIX"

data(model) = sprintf("%s/%s/force_separation.csv", ARG1, model)

# Bridged and apart. On the way in there is no bridge.
separation(dummy) = column("bridge") == 1 && column("separation_m") >= 0 ? 1e3 * column("separation_m") : NaN
force(dummy) = -1e6 * column("capillary_force_N")

set datafile separator comma
set title ARG2
set xlabel "separation {/:Italic S} (mm)"
set ylabel "capillary force {/:Italic F} (µN)"
set xrange [0:*]
set yrange [0:*]
set grid linecolor rgb "#cccccc"
set key top right

# Colours of Okabe and Ito, which colour-blind readers tell apart; dashes tell curves apart that lie on each other.
set style line 1 linewidth 2 linecolor rgb "#D55E00"
set style line 2 linewidth 5 linecolor rgb "#56B4E9"
set style line 3 linewidth 2 linecolor rgb "#000000" dashtype 2

draw = "plot \
    data('LiquidBridgeClassicalWillett') using (separation(0)):(force(0)) with lines linestyle 2 title 'Willett, classical', \
    data('LiquidBridgeBagheri') using (separation(0)):(force(0)) with lines linestyle 3 title 'Bagheri', \
    data('LiquidBridgeWillett') using (separation(0)):(force(0)) with lines linestyle 1 title 'Willett, simplified'"

set encoding utf8
set terminal pngcairo size 1200,800 fontscale 1.4 linewidth 1.5
set output ARG3.".png"
@draw
set terminal svg size 720,480 font "Helvetica,14" background "white"
set output ARG3.".svg"
@draw
