# Friction and solid fraction over the inertial number, from runs of ShearCell at several solid fractions.
#   gnuplot -c Drivers/ShearCell/plot.gp FOLDER    FOLDER/*/stress.csv; writes FOLDER/friction.png
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
# The means of each run over the second half of its strain.
rows = system("for f in '".ARG1."'/*/stress.csv; do awk -F, 'NR > 1 { row[++n] = $0 } END { for (k = int(n / 2) + 1; k <= n; k++) { split(row[k], c, \",\"); phi = c[3]; p += c[4]; t += c[5]; i += c[7]; m++ } print phi \",\" i / m \",\" t / p }' \"$f\"; done")
set print $means
print rows
unset print
set output ARG1."/friction.png"
set multiplot layout 2, 1
set logscale x
set format x "10^{%T}"
set ylabel "friction of the bulk"
set yrange [0:*]
plot $means using 2:3 with linespoints linestyle 1 notitle
set xlabel "inertial number"
set ylabel "solid fraction"
set yrange [*:*]
plot $means using 2:1 with linespoints linestyle 2 notitle
unset multiplot
