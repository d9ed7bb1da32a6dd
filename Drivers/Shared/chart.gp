# What the charts of the drivers share; `load` it, then set the output and plot.
set datafile separator comma
set encoding utf8
set terminal pngcairo size 1200,800 fontscale 1.4 linewidth 1.5
set grid linecolor rgb "#cccccc"
# Colours of Okabe and Ito, which colour-blind readers tell apart.
set style line 1 linewidth 2 linecolor rgb "#D55E00" pointtype 7 pointsize 1.6
set style line 2 linewidth 2 linecolor rgb "#0072B2" pointtype 7 pointsize 1.6
set style line 3 linewidth 2 linecolor rgb "#009E73" pointtype 7 pointsize 1.6
set style line 4 linewidth 2 linecolor rgb "#000000" dashtype 2
