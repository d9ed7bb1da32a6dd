# Errors of fields over their cost, from the table of Tools/Studies/FieldCosts/measure-fields.sh.
#   gnuplot -c Tools/Studies/FieldCosts/field-costs.gp TABLE.csv OUTPUT_WITHOUT_SUFFIX
if (ARGC < 2) exit error "give TABLE.csv OUTPUT_WITHOUT_SUFFIX"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
set datafile commentschars "#"
set terminal pngcairo size 1700,650 fontscale 1.0 linewidth 1.5
set output ARG2.".png"
array names = ["Z", "XZ", "XYZ"]
array colours = ["#D55E00", "#0072B2", "#009E73"]
of(study, k) = stringcolumn("study") eq study && stringcolumn("coordinates") eq names[k]
cost(study, k) = of(study, k) ? column("percent_of_run") : NaN
set logscale xy
set format y "10^{%T}"
set key bottom left samplen 1 opaque
set xlabel "cost of a sample (% of 100 steps)"
set multiplot layout 1,3
set title "cut-off (in widths; points a width apart)"
set ylabel "error against a cut-off at 8 widths"
plot for [k = 1:3] ARG1 using (cost("cut-off", k)):(column("error_of_cut_off")) with linespoints linestyle k title names[k], \
     for [k = 1:3] ARG1 using (cost("cut-off", k)):(column("error_of_cut_off")):(sprintf("  %g", column("cut_off_over_width"))) \
         with labels left textcolor rgb colours[k] notitle
set title "distance of points (in widths; cut-off 3)"
set ylabel "error of straight lines between points"
plot for [k = 1:3] ARG1 using (cost("grid", k)):(column("error_between_points")) with linespoints linestyle k title names[k], \
     for [k = 1:3] ARG1 using (cost("grid", k)):(column("error_between_points")):(sprintf("  %g", column("spacing_over_width"))) \
         with labels left textcolor rgb colours[k] notitle
set title "steps between samples (50 make a contact)"
set xlabel "cost (% of the run)"
set ylabel "error of the mean over the strain"
plot ARG1 using (stringcolumn("study") eq "interval" && column("error_of_mean") > 0 ? column("percent_of_run") : NaN):(column("error_of_mean")) \
         with linespoints linestyle 1 notitle, \
     ARG1 using (stringcolumn("study") eq "interval" && column("error_of_mean") > 0 ? column("percent_of_run") : NaN):(column("error_of_mean")):(sprintf("  %g", column("steps_between_samples"))) \
         with labels left textcolor rgb colours[1] notitle
unset multiplot
