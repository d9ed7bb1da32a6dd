# The liquid on each grain, and the velocity, across the slit of the floor.
#   gnuplot -c Drivers/LiquidInShear/plot.gp FOLDER    FOLDER: the driver's --output; writes FOLDER/profile.png
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
profile = ARG1."/profile.csv"
times = ""
last = -1
stats profile using (column("time_s") != last ? (times = times.sprintf(" %.10g", column("time_s")), last = column("time_s")) : 0) nooutput
first = real(word(times, 2))
middle = real(word(times, (words(times) + 2) / 2))
end = real(word(times, words(times)))
at(time, value) = abs(column("time_s") - time) < 1e-9 ? value : NaN

set output ARG1."/profile.png"
set multiplot layout 2, 1
set ylabel "liquid of a grain (10^{-12} m^3)"
set yrange [0:*]
set key bottom right
plot for [k = 1:3] profile using (1e3 * column("y_m")):(at(k == 1 ? first : k == 2 ? middle : end, 1e12 * (column("film_m3") + column("bridges_m3")))) \
     with linespoints linestyle k title sprintf("%g s", k == 1 ? first : k == 2 ? middle : end)
set xlabel "distance from the slit (mm)"
set ylabel "velocity along the slit (mm/s)"
set yrange [*:*]
plot profile using (1e3 * column("y_m")):(at(end, 1e3 * column("velocity_m/s"))) with linespoints linestyle 3 notitle
unset multiplot
