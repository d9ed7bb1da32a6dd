# Where dry contact laws fail, from the tables of Tools/Studies/accuracy-versus-cost --contact-maps.
#   gnuplot -c Tools/Studies/AccuracyVersusCost/contact-maps.gp FOLDER
# draws FOLDER/restitution.png, attraction.png, sliding-onset.png and impact-speed.png.
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
set datafile commentschars "#"
folder = ARG1
normals = "LinearViscoelastic HertzianViscoelastic HertzianBSHPViscoelastic LinearPlasticViscoelastic HertzianPlasticViscoelastic"
array lawColours[5] = ["#000000", "#D55E00", "#0072B2", "#009E73", "#CC79A7"]
array colours[8] = ["#000000", "#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7"]

# Restitution: rows of the loss, columns of the step; the rows are those of the table in their order.
levels = "2c 1c 0.02 0.05 0.1 0.15 0.2 0.25 0.3 0.4 0.5 0.6 0.7 0.8 0.9 0.95 1"
steps = "5 7 10 14 20 30 50 100 200 500"
# Columns of the steps and of the loss as numbers of their places, and the error.
places = "function place(list, value,  parts, k, n) { n = split(list, parts, \" \"); for (k = 1; k <= n; ++k) if (parts[k] == value) return k; return 0 }"
cells(law, integrator) = sprintf("< awk -F, -v steps='%s' -v levels='%s' '%s $1 == \"%s\" && $2 == \"%s\" { e = $6 < 0 ? -$6 : $6; print place(steps, $5), place(levels, $4 == 0 ? $3 \"c\" : $4), (e < 1e-6 ? 1e-6 : e) }' '%s/restitution.csv'", \
    steps, levels, places, law, integrator, folder)
set datafile separator whitespace
set terminal pngcairo size 1700,900 fontscale 0.75
set output folder."/restitution.png"
unset grid
set multiplot layout 2,5 margins 0.06,0.93,0.08,0.93 spacing 0.012,0.08
set logscale cb
set cbrange [1e-5:1]
set palette defined (0 "#DDEEFF", 1 "#F0E442", 2 "#E69F00", 3 "#D55E00", 4 "#000000")
set xrange [0.5:10.5]
set yrange [0.5:17.5]
set tics front out nomirror
do for [integrator in "PredictedVelocityVerlet VelocityVerlet"] {
    do for [i = 1:5] {
        law = word(normals, i)
        set title law.(integrator eq "VelocityVerlet" ? ", velocity Verlet" : ", default") offset 0,-0.7 font ",9"
        unset xtics; unset ytics
        set xtics out nomirror
        set for [k = 1:10] xtics add (word(steps, k) k)
        set xlabel (integrator eq "VelocityVerlet" ? "steps per elastic contact" : "") offset 0,0.5
        set ylabel (i == 1 ? "restitution set (2c, 1c: twice, once critical)" : "") offset 0.5,0
        set ytics out nomirror ()
        set for [k = 1:17] ytics add ((i == 1 ? word(levels, k) : "") k)
        if (i == 5) { set colorbox user origin 0.94,(integrator eq "VelocityVerlet" ? 0.08 : 0.545) size 0.012,0.385; set cblabel "largest error of {/:Italic e}" } else { unset colorbox; unset cblabel }
        plot cells(law, integrator) using 1:2:3 with image notitle
    }
}
unset multiplot
unset logscale
unset colorbox
set xtics autofreq; set ytics autofreq
set xtics norangelimit; unset title; unset cblabel

# The normal force over time: red where it pushes, blue where it pulls.
force(law) = sprintf("< awk -F, -v levels='%s' '%s $1 == \"%s\" { print $4, place(levels, $2 == 0 ? $3 \"c\" : $2), $6 }' '%s/normal-force.csv'", levels, places, law, folder)
ends(law, column) = sprintf("< awk -F, -v levels='%s' '%s $1 == \"%s\" && $%d != \"\" { print $%d, place(levels, $2 == 0 ? $3 \"c\" : $2) }' '%s/attraction.csv'", levels, places, law, column, column, folder)
set terminal pngcairo size 1700,560 fontscale 0.75
set output folder."/attraction.png"
set multiplot layout 1,5 margins 0.06,0.93,0.13,0.9 spacing 0.012,0.08
set palette defined (-1 "#0072B2", 0 "#FFFFFF", 1 "#D55E00")
set cbrange [-0.3:0.3]
set xrange [0:2.5]
set xtics 0.5
do for [i = 1:5] {
    law = word(normals, i)
    set title law offset 0,-0.7 font ",9"
    set xlabel "time / elastic contact time"
    set ylabel (i == 1 ? "restitution of the dashpot (2c, 1c: twice, once critical)" : "")
    unset ytics
    set ytics out nomirror ()
    set for [k = 1:17] ytics add ((i == 1 ? word(levels, k) : "") k)
    if (i == 5) { set colorbox user origin 0.94,0.13 size 0.012,0.77; set cblabel "force / largest force" } else { unset colorbox; unset cblabel }
    plot force(law) using 1:2:3 with points pointtype 5 pointsize 1.9 linecolor palette notitle, \
         ends(law, 4) using 1:2:(0):(0.45) with yerrorbars pointtype 0 linewidth 2 linecolor rgb "#000000" notitle
}
unset multiplot
unset colorbox; unset cblabel
set ytics autofreq; set ytics norangelimit

# Sliding: how far the push at its onset is from theory.
set terminal pngcairo size 1700,820 fontscale 0.75 linewidth 1.3
set output folder."/sliding-onset.png"
set grid linecolor rgb "#cccccc"
set logscale xy
set xrange [6:120]
set xtics (7, 10, 20, 50, 100)
set yrange [0.01:200]
set ytics (0.01, 0.1, 1, 10, 100)
array dampings[6] = [0, 0.02, 0.1, 0.3, 1, 2]
frictions = "SlidingFriction SlidingRollingTorsion MindlinRollingTorsion Mindlin MindlinSecant"
onset(law, integrator, ratio, damping) = sprintf("< awk -F, '$1 == \"%s\" && $2 == \"%s\" && $3 == %g && $4 == %g { e = 100 * ($7 - 1); print $5, e < 0 ? -e : e }' '%s/sliding-onset.csv'", \
    law, integrator, ratio, damping, folder)
set multiplot layout 2,5 margins 0.06,0.99,0.08,0.95 spacing 0.03,0.09
do for [integrator in "PredictedVelocityVerlet VelocityVerlet"] {
    do for [i = 1:5] {
        law = word(frictions, i)
        ratio = i <= 3 ? 1.5 : 1
        set title sprintf("%s, %s%s", law, integrator eq "VelocityVerlet" ? "velocity Verlet" : "default", i <= 3 ? ", {/Symbol m}_s = 1.5 {/Symbol m}_d" : "") offset 0,-0.7 font ",9"
        set xlabel (integrator eq "VelocityVerlet" ? "steps per tangential period" : "")
        set ylabel (i == 1 ? "error of the push at onset (%)" : "")
        if (i == 1) { set key top right title "damping / critical" } else { unset key }
        plot for [k = 1:6] onset(law, integrator, ratio, dampings[k]) using 1:2 with linespoints pointtype 7 pointsize 0.7 linewidth 1.5 linecolor rgb colours[k] title sprintf("%g", dampings[k])
    }
}
unset multiplot

# Overlap and contact time over the speed: points of the runs, lines of theory.
set terminal pngcairo size 1700,900 fontscale 0.75 linewidth 1.3
set output folder."/impact-speed.png"
set key top left notitle
set format "10^{%T}"
set xrange [1e-6:1e3]
set xtics 1e-6, 1e3
set ytics autofreq
# A list without points has one outside of the chart, or gnuplot warns.
impact(grain, law, regions, y) = sprintf("< awk -F, '$1 == \"%s\" && $2 == \"%s\" && $4 ~ /[%s]/ && $%d != \"\" { print $3, $%d, $12; found = 1 } END { if (!found) print 1e99, 1e99, 1e99 }' '%s/impact-speed.csv'", grain, law, regions, y, y, folder)
set multiplot layout 2,3 margins 0.06,0.99,0.08,0.95 spacing 0.04,0.1
do for [what in "overlap time"] {
    do for [grain in "glass steel soft"] {
        overlaps = what eq "overlap"
        seen = overlaps ? 6 : 8
        set title grain offset 0,-0.7
        set xlabel (overlaps ? "" : "impact speed (m/s)")
        set ylabel (overlaps ? "largest overlap / radius" : "contact time (s)")
        if (overlaps) { set yrange [1e-9:10] } else { set yrange [1e-6:1e-2] }
        if (overlaps && grain eq "glass") { set key } else { unset key }
        plot for [k = 1:5] impact(grain, word(normals, k), "01", seen) using 1:2 with points pointtype 6 pointsize 0.8 linecolor rgb lawColours[k] title word(normals, k), \
             for [k = 1:5] impact(grain, word(normals, k), "0123", seen + 1) using 1:2 with lines linewidth 1 linecolor rgb lawColours[k] title (k == 1 ? "theory" : ""), \
             (overlaps ? 0.05 : NaN) with lines dashtype 2 linecolor rgb "#888888" title "5 % of the radius", \
             for [k = 1:5] impact(grain, word(normals, k), "2", 7) using 1:(overlaps ? 7 / 1.7 ** k : NaN) with points pointtype 2 pointsize 0.7 linecolor rgb lawColours[k] title (k == 1 ? "refused: overlap" : ""), \
             for [k = 1:5] impact(grain, word(normals, k), "3", 7) using 1:(overlaps ? 7 / 1.7 ** k : NaN) with points pointtype 5 pointsize 0.7 linecolor rgb lawColours[k] title (k == 1 ? "refused: speed" : ""), \
             (overlaps && grain ne "soft" ? impact(grain, normals[1:18], "0", 12) : impact("none", "none", "0", 12)) using 3:(1e-9):(0):(1e10) every ::0::0 with vectors nohead dashtype 3 linecolor rgb "#888888" title "begins to yield"
    }
}
unset multiplot
