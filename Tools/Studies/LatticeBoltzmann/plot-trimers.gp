# Bridges of three grains to which liquid is added: whether they are one, and the force along a side, beside two exact bridges.
#   gnuplot -c Tools/Studies/LatticeBoltzmann/plot-trimers.gp TRIMERS.CSV OUTPUT.PNG THREE-GRAINS.CSV
if (ARGC < 3) exit error "give TRIMERS.CSV OUTPUT.PNG THREE-GRAINS.CSV"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
set output ARG2
set datafile commentschars "#"
of(radius, gap, bridges, what) = column("radius") == radius && abs(column("gap") - gap) < 1e-6 && column("bridges") == bridges ? column(what) : NaN
# By Surface Evolver: 40 degrees, 0.6 R^3, a gap of 0.2.
evolver(what) = column("theta_deg") == 40 && abs(column("gap") - 0.2) < 1e-6 ? column(what) : NaN
radii = "14 20 10"
gaps = "0.2 0.2 0.3"
set multiplot layout 1, 2
set xlabel "liquid / volume of a grain"
set xrange [0:0.2]
set yrange [0:*]
set ylabel "area of liquid half way between the two bridges / R²"
plot for [k = 1:3] ARG1 using "volume":(of(word(radii, k) + 0, word(gaps, k) + 0, 2, "section")) with linespoints linestyle k pointtype 7 notitle, \
     for [k = 1:2] ARG1 using "volume":(of(word(radii, k) + 0, 0.2, 3, "section")) with points linestyle k pointtype 6 pointsize 2 notitle
set ylabel "force along a side / γ R"
set key bottom right
plot for [k = 1:3:2] ARG1 using "volume":(of(word(radii, k) + 0, word(gaps, k) + 0, 2, "exact_force")) with lines linestyle k dashtype 2 title "two exact bridges, gap ".word(gaps, k)." R", \
     for [k = 1:3] ARG1 using "volume":(of(word(radii, k) + 0, word(gaps, k) + 0, 2, "pair_force")) with linespoints linestyle k pointtype 7 title "begun as two, ".word(gaps, k)." R, R = ".word(radii, k), \
     for [k = 1:2] ARG1 using "volume":(of(word(radii, k) + 0, 0.2, 3, "pair_force")) with points linestyle k pointtype 6 pointsize 2 title "begun as three, 0.2 R, R = ".word(radii, k), \
     ARG3 using (0.6 * 3 / (4 * pi)):(evolver("pair_force")) with points linestyle 4 pointtype 5 title "one, Surface Evolver, 0.2 R"
unset multiplot
