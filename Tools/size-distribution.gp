# Grain sizes, and the error of samples of them, from the tables of Tools/size-distribution.
#   gnuplot -c Tools/size-distribution.gp CURVES.csv OUTPUT_WITHOUT_SUFFIX [ERRORS.csv]
# CURVES.csv: printed without --draw; ERRORS.csv: printed with --errors.
if (ARGC < 2) exit error "give CURVES.csv OUTPUT_WITHOUT_SUFFIX [ERRORS.csv]"
load system("dirname '".ARG0."'")."/../Drivers/Shared/chart.gp"
set datafile commentschars "#"
bases = "number length area volume"

set terminal pngcairo size (ARGC > 2 ? 1800 : 1200),680 fontscale 1.1 linewidth 1.5
set output ARG2.".png"
set multiplot layout 1,(ARGC > 2 ? 3 : 2)
set logscale x
set xlabel "diameter {/:Italic d} (mm)"
set ylabel "fraction of the grains up to {/:Italic d}"
set yrange [0:1]
set key top left
plot for [k = 1:4] ARG1 using (1e3*$1):(column("cumulative_".word(bases, k))) with lines linestyle k title "by ".word(bases, k)
set ylabel "density in ln {/:Italic d}"
set yrange [0:*]
plot for [k = 1:4] ARG1 using (1e3*$1):($1*column("density_".word(bases, k)."_per_m")) with lines linestyle k title "by ".word(bases, k)
if (ARGC > 2) {
    set logscale xy
    set format y "%g %%"
    set xlabel "grains"
    set ylabel "largest error of a volume fraction"
    set yrange [*:*]
    set key bottom left
    plot ARG3 using 1:(100*$3) with linespoints linestyle 2 dashtype 2 title "random, largest", \
         ARG3 using 1:(100*$2) with linespoints linestyle 2 title "random, mean", \
         ARG3 using 1:(100*$4) with linespoints linestyle 1 title "exact counts"
}
unset multiplot
