# Bridges whose volume changes, from the table of Tools/Studies/accuracy-versus-cost --bridge-volumes.
#   gnuplot -c Tools/Studies/AccuracyVersusCost/bridge-volumes.gp TABLE.CSV OUTPUT_WITHOUT_SUFFIX
if (ARGC < 2) exit error "give TABLE.CSV OUTPUT_WITHOUT_SUFFIX"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
set datafile commentschars "#"
table = ARG1
array laws = ["Willett", "Bagheri", "LianSeville", "YoungLaplace"]
array colours = ["#E69F00", "#D55E00", "#0072B2", "#009E73"]
ofLaw(k, share) = sprintf("< awk -F, '$1 == \"LiquidBridge%s\" && $2 == %s' '%s'", laws[k], share, table)
floorOf(error) = error > 3e-5 ? error : 3e-5

set terminal pngcairo size 1500,620 fontscale 1.05 linewidth 1.4
set output ARG2.".png"
set logscale xy
set xrange [0.4:9000]
set yrange [2e-5:2]
set format y "%g %%"
set xtics (1, 10, 100, 1000)
set xlabel "force and preparation of a bridge in a step (ns)"
set multiplot layout 1,3
do for [share in "0.1 0.01 0.001"] {
    set title "volume changes by ".share." % in a step"
    set ylabel (share eq "0.1" ? "rms error of the force (lowest: none)" : "")
    if (share eq "0.001") { set key top right font ",11" samplen 2 } else { unset key }
    plot for [k = 1:4] ofLaw(k, share) using 10:(floorOf(column(4))) with linespoints pointtype 7 pointsize 1.4 linecolor rgb colours[k] title laws[k], \
         ofLaw(4, share) using 10:(floorOf(column(4))):(column(3) == 0 ? "each step" : sprintf("at %g %%", column(3))) with labels left offset 1,0.3 font ",11" notitle
}
unset multiplot
