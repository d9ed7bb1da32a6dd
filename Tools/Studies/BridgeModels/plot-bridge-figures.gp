# Figures 3, 4, 5, 6 and 9 of Yang, Sega and Harting (2021) with the exact curves, from the tables of Tools/Studies/bridge-figures.
#   gnuplot -c Tools/Studies/BridgeModels/plot-bridge-figures.gp FOLDER    FOLDER: its --output; writes FOLDER/figure-3.png and so on
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"

# Colours of Okabe and Ito; the exact curve is wide and grey, below the others.
set style line 1 linewidth 6 linecolor rgb "#BBBBBB"
set style line 2 linewidth 2 linecolor rgb "#000000"
set style line 3 linewidth 2 linecolor rgb "#0072B2" dashtype 2
set style line 4 linewidth 2 linecolor rgb "#009E73"
set style line 5 linewidth 2 linecolor rgb "#E69F00"
set style line 6 linewidth 2 linecolor rgb "#D55E00"
set style line 7 linewidth 2 linecolor rgb "#D55E00" dashtype 3

figure(number) = sprintf("%s/figure-%d.csv", ARG1, number)
# The separation in the rows of one case, elsewhere no number, so that only these are drawn.
only(angle, volume) = abs(column("contact_angle_deg") - angle) < 0.01 && abs(column("volume_over_sphere") - volume) < 1e-6 ? \
    column("separation_over_R") : NaN
ofRatio(unequal) = (column("radius_ratio") > 1.01) == unequal ? 1 : NaN
# An empty cell is a gap in the curve.
number(name) = strlen(stringcolumn(name)) > 0 ? column(name) : NaN
force(name) = number(name."_force_over_R_gamma")
angle(name) = number(name."_filling_angle_deg")
set xlabel "separation {/:Italic S/R}"
set xrange [0:1.45]
set grid linewidth 0.5

# The panel at hand; its curves.
here(dummy) = only(panelAngle, panelVolume)
drawForces = "plot \
    figure(panelFigure) using (here(0)):(force('exact')) with lines linestyle 1 title 'exact', \
    '' using (here(0)):(force('lian')) with lines linestyle 2 title 'A  Lian', \
    '' using (here(0)):(force('pietsch_rumpf')) with lines linestyle 3 title 'B  Pietsch, Rumpf', \
    '' using (here(0)):(force('classical_willett')) with lines linestyle 4 title 'C  Willett', \
    '' using (here(0)):(force('rabinovich')) with lines linestyle 5 title 'D  Rabinovich', \
    '' using (here(0)):(force('mikami')) with lines linestyle 6 title 'E  Mikami', \
    '' using (here(0)):(force('mikami_half_separation')) with lines linestyle 7 title 'E, half separation'"

set ylabel "force {/:Italic F/(R γ)}"
set yrange [0:6]
set key top right samplen 2 spacing 0.9

set terminal pngcairo size 3 * 430, 400 fontscale 1 linewidth 1.3
set output ARG1."/figure-3.png"
set multiplot layout 1, 3 title "Figure 3: equal spheres, {/:Italic V*} = 0.133"
panelFigure = 3
panelVolume = 0.133
do for [name in "34.6 48 60"] {
    panelAngle = real(name)
    set title sprintf("{/:Italic θ} = %s°", name)
    if (name eq "60") { set key } else { unset key }
    eval drawForces
}
unset multiplot

set terminal pngcairo size 2 * 500, 420 fontscale 1 linewidth 1.3
set output ARG1."/figure-4.png"
set multiplot layout 1, 2 title "Figure 4: equal spheres, {/:Italic θ} = 48°"
panelFigure = 4
panelAngle = 48
do for [name in "0.07 0.25"] {
    panelVolume = real(name)
    set title sprintf("{/:Italic V*} = %s", name)
    if (name eq "0.25") { set key } else { unset key }
    eval drawForces
}
unset multiplot

# Curves of several cases in one panel: a colour for each case, a kind of line for each model.
colour(k) = word("#D55E00 #0072B2 #009E73", k)
theta(k) = real(word("34.6 48 60", k))
volume(k) = real(word("0.07 0.133 0.25", k))

set output ARG1."/figure-5.png"
set multiplot layout 1, 2 title "Figure 5: spheres of 70 and 90"
set yrange [0:4]
set title "{/:Italic V*} = 0.133"
plot for [k = 1:3] figure(5) using (only(theta(k), 0.133)):(force('exact')) with lines linewidth 6 linecolor rgb "#CCCCCC" \
         title k == 1 ? "exact" : "", \
     for [k = 1:3] '' using (only(theta(k), 0.133)):(force('chen')) with lines linewidth 2 linecolor rgb colour(k) \
         title sprintf("F  Chen, %g°", theta(k)), \
     for [k = 1:3] '' using (only(theta(k), 0.133)):(force('classical_willett')) with lines linewidth 2 dashtype 2 \
         linecolor rgb colour(k) title sprintf("C  Willett, %g°", theta(k))
set title "{/:Italic θ} = 48°"
plot for [k = 1:3] figure(5) using (only(48, volume(k))):(force('exact')) with lines linewidth 6 linecolor rgb "#CCCCCC" \
         title k == 1 ? "exact" : "", \
     for [k = 1:3] '' using (only(48, volume(k))):(force('chen')) with lines linewidth 2 linecolor rgb colour(k) \
         title sprintf("F  Chen, {/:Italic V*} = %g", volume(k)), \
     for [k = 1:3] '' using (only(48, volume(k))):(force('classical_willett')) with lines linewidth 2 dashtype 2 \
         linecolor rgb colour(k) title sprintf("C  Willett, {/:Italic V*} = %g", volume(k))
unset multiplot

# The liquid, and the spheres on it.
set terminal pngcairo size 2 * 400, 2 * 430 fontscale 1 linewidth 1.3
set output ARG1."/figure-6.png"
set multiplot layout 2, 2 title "Figure 6: equal spheres, exact (contact lines free to move)"
drawn(part) = only6(part) ? column("x_over_R") : NaN
only6(part) = column("part") == part && column("contact_angle_deg") == panelAngle && column("separation_over_R") == panelGap
set xlabel "{/:Italic x/R}"
set ylabel "{/:Italic z/R}"
set xrange [-1.6:1.9]
unset key
set style fill solid 1 border
do for [panel = 1:4] {
    panelAngle = real(word("90 132 90 132", panel))
    panelGap = real(word("0.572 0.572 1.144 1.144", panel))
    panelVolume = real(word("0.5 0.5 0.65 0.65", panel))
    set yrange [*:*]  # statistics count what is in the range
    stats figure(6) using (only6(0) ? column("force_over_R_gamma") : NaN) name "here" nooutput
    stats figure(6) using (only6(0) ? column("force_on_axis_over_R_gamma") : NaN) name "axis" nooutput
    set title sprintf("{/:Italic θ} = %g°, {/:Italic S/R} = %g, {/:Italic V*} = %g\n{/:Italic F/(R γ)} = %.3g (on the axis %.3f)", \
                      panelAngle, panelGap, panelVolume, here_max, axis_max)
    set yrange [-1.2:2.3]
    set size ratio -1
    plot figure(6) using (drawn(0)):"z_over_R" with filledcurves closed linecolor rgb "#9ECAE1", \
         for [part = 1:2] '' using (drawn(part)):"z_over_R" with filledcurves closed linecolor rgb "#888888"
}
unset multiplot
set size noratio
set xlabel "separation {/:Italic S/R}"
set xrange [0:1.45]
set style fill empty
set key

set terminal pngcairo size 2 * 440, 400 fontscale 0.9 linewidth 1.3
set output ARG1."/figure-9.png"
set multiplot layout 1, 2 title "Figure 9: half-filling angle"
set ylabel "half-filling angle {/:Italic φ} (°)"
set yrange [15:65]
set title "equal spheres"
plot for [k = 1:3] figure(9) using (ofRatio(0) * only(theta(k), 0.133)):(angle('exact_first')) with lines linewidth 6 \
         linecolor rgb "#CCCCCC" title k == 1 ? "exact" : "", \
     for [k = 1:3] '' using (ofRatio(0) * only(theta(k), 0.133)):(angle('toroid_first')) with lines linewidth 2 \
         linecolor rgb colour(k) title sprintf("toroid, %g°, {/:Italic V*} = 0.133", theta(k)), \
     for [k = 1:3:2] '' using (ofRatio(0) * only(48, volume(k))):(angle('exact_first')) with lines linewidth 6 \
         linecolor rgb "#CCCCCC" title "", \
     for [k = 1:3:2] '' using (ofRatio(0) * only(48, volume(k))):(angle('toroid_first')) with lines linewidth 2 \
         dashtype k + 1 linecolor rgb colour(2) title sprintf("toroid, 48°, {/:Italic V*} = %g", volume(k))
set title "spheres of 70 (upper curves) and 90, {/:Italic V*} = 0.133"
plot for [k = 1:3:2] figure(9) using (ofRatio(1) * only(theta(k), 0.133)):(angle('exact_first')) with lines linewidth 6 \
         linecolor rgb "#CCCCCC" title k == 1 ? "exact" : "", \
     for [k = 1:3:2] '' using (ofRatio(1) * only(theta(k), 0.133)):(angle('exact_second')) with lines linewidth 6 \
         linecolor rgb "#CCCCCC" title "", \
     for [k = 1:3:2] '' using (ofRatio(1) * only(theta(k), 0.133)):(angle('toroid_first')) with lines linewidth 2 \
         linecolor rgb colour(k) title sprintf("arc, %g°", theta(k)), \
     for [k = 1:3:2] '' using (ofRatio(1) * only(theta(k), 0.133)):(angle('toroid_second')) with lines linewidth 2 \
         dashtype 2 linecolor rgb colour(k) title ""
unset multiplot
