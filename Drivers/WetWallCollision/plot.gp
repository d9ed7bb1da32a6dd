# Figures 6 to 13 of the force balance model of wet particle-wall collisions, from the tables of make-figures.sh.
#   gnuplot -c Drivers/WetWallCollision/plot.gp FOLDER    writes FOLDER/figure-6.png to figure-13.png
if (ARGC < 1) exit error "give FOLDER"
here = system("dirname '".ARG0."'")
load here."/../Shared/chart.gp"
table(figure, curve) = sprintf("%s/%d/%s/collisions.csv", ARG1, figure, curve)
colour(k) = word("#000000 #0072B2 #009E73 #D55E00 #E69F00 #CC79A7", k)


set terminal pngcairo size 900,600 fontscale 1.2 linewidth 1.3
set output ARG1."/figure-6.png"
set title "Figure 6: glass 1.74 mm, 400 μm of water, 1 m/s"
set xlabel "steps for the time of a dry contact"
set ylabel "error of the normal restitution"
set logscale xy
set format y "10^{%L}"
set key top right
plot table(6, "glass-A") using "steps_per_contact":(abs(column("normal_restitution") - 0.5567490366)) with linespoints linestyle 1 \
         title "A, against 0.5567490366", \
     1e-3 with lines linecolor rgb "#888888" dashtype 3 title "1e-3"
unset logscale
set format y "%g"

set xlabel "speed (m/s)"
set ylabel "normal restitution"
set xrange [0:5]
set yrange [0:1]
set key bottom right samplen 2 spacing 0.9
set terminal pngcairo size 1600,1150 fontscale 1.1 linewidth 1.3
set output ARG1."/figure-7.png"
set multiplot layout 2, 2 title "Figure 7: glass spheres; A (solid): the bridge grows, B (dashed): it keeps its volume"
do for [part = 1:4] {
    if (part == 1) { set title "(a) 1.74 mm, water"; names = "a-100 a-200 a-400"; titles = "100μm 200μm 400μm" }
    if (part == 2) { set title "(b) 0.91 mm, water"; names = "b-100 b-200"; titles = "100μm 200μm" }
    if (part == 3) { set title "(c) 1.74 mm, 200 μm (see the README)"; names = "c-water c-glycerol35 c-glycerol51"; titles = "water 35%glycerol 51%glycerol" }
    if (part == 4) { set title "(d) 1.74 mm, 100 μm"; names = "d-water d-tween"; titles = "water Tween20" }
    plot table(7, "a-dry") using "speed_m/s":"normal_restitution" with lines linewidth 2 linecolor rgb colour(1) title "dry", \
         for [k = 1:words(names)] table(7, word(names, k)."-A") using "speed_m/s":"normal_restitution" with lines linewidth 2 \
             linecolor rgb colour(k + 1) title word(titles, k), \
         for [k = 1:words(names)] table(7, word(names, k)."-B") using "speed_m/s":"normal_restitution" with lines linewidth 2 \
             dashtype 2 linecolor rgb colour(k + 1) title ""
}
unset multiplot

set terminal pngcairo size 1600,600 fontscale 1.1 linewidth 1.3
set output ARG1."/figure-8.png"
set multiplot layout 1, 2 title "Figure 8: γ-Al_2O_3, 1.74 mm"
do for [part = 1:2] {
    if (part == 1) { set title "(a) water"; names = "a-100 a-200 a-400"; titles = "100μm 200μm 400μm" }
    if (part == 2) { set title "(b) 200 μm"; names = "a-200 b-glycerol35 b-glycerol51"; titles = "water 35%glycerol 51%glycerol" }
    plot table(8, "a-dry") using "speed_m/s":"normal_restitution" with lines linewidth 2 linecolor rgb colour(1) title "dry", \
         for [k = 1:words(names)] table(8, word(names, k)."-A") using "speed_m/s":"normal_restitution" with lines linewidth 2 \
             linecolor rgb colour(k + 1) title word(titles, k), \
         for [k = 1:words(names)] table(8, word(names, k)."-B") using "speed_m/s":"normal_restitution" with lines linewidth 2 \
             dashtype 2 linecolor rgb colour(k + 1) title ""
}
unset multiplot

set output ARG1."/figure-9.png"
set multiplot layout 1, 2 title "Figure 9: where the energy went (A)"
set xrange [0.5:3.5]
set yrange [0:*]
set ylabel "lost energy (J/kg)"
set style fill solid 0.9
set boxwidth 0.3
set key top left
parts = "contact gravity viscosity capillarity"
columns = "lost_in_contact_J/kg lost_to_gravity_J/kg lost_to_viscosity_J/kg lost_to_capillarity_J/kg"
speeds = "1 1.5 2 2.5 3"
below(n) = n == 0 ? 0 : below(n - 1) + column(word(columns, n))
do for [size in "large small"] {
    set title size eq "large" ? "(a) 1.74 mm, 400 μm of water" : "(b) 0.91 mm, 200 μm of water"
    plot for [n = 4:1:-1] for [speed in speeds] table(9, size."-".speed."-A") using "speed_m/s":(below(n)) with boxes \
        linecolor rgb colour(n + 1) title speed eq "1" ? word(parts, n) : ""
}
unset multiplot

set xlabel "angle of the path from the normal (degrees)"
set xrange [0:90]
set xtics 15
unset key
set key top right samplen 2 spacing 0.9
quantities = "normal_restitution tangential_restitution spin_after_rad/s rotational"
set terminal pngcairo size 1600,1150 fontscale 1.1 linewidth 1.3
do for [number = 10:13] {
    if (number == 10) { names = "dry200 dry0 dry-300 tween200 tween0 tween-300"; what = "γ-Al_2O_3, dry and 100 μm of Tween 20, three initial spins (rad/s)" }
    if (number == 11) { names = "tween-623 tween-961 tween-1366 tween-1777"; what = "γ-Al_2O_3, 100 μm of Tween 20, four initial spins (rad/s)" }
    if (number == 12) { names = "tween-960"; what = "γ-Al_2O_3, 100 μm of Tween 20, initial spin -960 rad/s" }
    if (number == 13) { names = "dry tween-100 tween-150 glycerol35-100"; what = "γ-Al_2O_3, initial spin -500 rad/s" }
    set output sprintf("%s/figure-%d.png", ARG1, number)
    set multiplot layout 2, 2 title sprintf("Figure %d: %s, normal speed 1 m/s", number, what)
    set yrange [0:1]
    set title "normal restitution"
    set ylabel "e_n"
    set key bottom right
    plot for [k = 1:words(names)] table(number, word(names, k)) using "angle_deg":"normal_restitution" with lines linewidth 2 linecolor rgb colour(k) title word(names, k)
    set yrange [-1:3]
    set key top right
    set title "tangential restitution"
    set ylabel "e_t"
    plot for [k = 1:words(names)] table(number, word(names, k)) using "angle_deg":"tangential_restitution" with lines linewidth 2 linecolor rgb colour(k) title word(names, k)
    set yrange [*:*]
    set title "spin after the collision"
    set ylabel "ω_R (rad/s)"
    plot for [k = 1:words(names)] table(number, word(names, k)) using "angle_deg":"spin_after_rad/s" with lines linewidth 2 linecolor rgb colour(k) title word(names, k)
    set title "rotational restitution ω_R/ω_0"
    set ylabel "e_ω"
    if (number > 10) {  # one spin of Figure 10 is 0
        plot for [k = 1:words(names)] table(number, word(names, k)) using "angle_deg":(column("spin_after_rad/s") / column("spin_rad/s")) with lines linewidth 2 linecolor rgb colour(k) title word(names, k)
    }
    unset multiplot
}
