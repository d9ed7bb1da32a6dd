# The eight benchmark tests of Chung and Ooi (2011), from the tables of Tools/Studies/impact-figures.
#   gnuplot -c Tools/Studies/ChungOoi/plot-impact-figures.gp FOLDER    FOLDER: its --output; writes FOLDER/test-1.png and so on
if (ARGC < 1) exit error "give FOLDER"
drivers = system("dirname '".ARG0."'")."/../../../Drivers"
load drivers."/Shared/chart.gp"
measured = drivers."/ObliqueImpact/kharaz-2001-measured.csv"
computed = drivers."/ObliqueImpact/chung-ooi-2011-computed.csv"
set datafile commentschars "#"
set terminal pngcairo size 990,330 fontscale 0.7 linewidth 1

table(test) = sprintf("%s/test-%d.csv", ARG1, test)
chart(test) = sprintf("%s/test-%d.png", ARG1, test)
# A cell in the rows of one material; elsewhere, and where it is empty, no number.
of(name, cell) = stringcolumn("material") eq name && strlen(stringcolumn(cell)) > 0 ? column(cell) : NaN

# A colour for each material: theory is a line, simulated impacts are points; full sliding is a broken black line.
colour(k) = k == 1 ? "#D55E00" : "#0072B2"
symbol(k) = k == 1 ? 6 : 4
# So that the first material is seen behind the second.
size(k) = k == 1 ? 1.1 : 0.6
width(k) = k == 1 ? 4 : 1.5
set key samplen 2 spacing 1.1

# One quantity of both materials over another column. Set: test, material, before, unitBefore, quantity, unit.
array material[2]
drawQuantity = "unset key; plot \
    for [k = 1:2] table(test) using (unitBefore * column(before)):(unit * of(material[k], 'theory_'.quantity)) with lines \
        linewidth width(k) linecolor rgb colour(k), \
    for [k = 1:2] '' using (unitBefore * column(before)):(unit * of(material[k], 'simulated_'.quantity)) with points \
        pointtype symbol(k) pointsize size(k) linecolor rgb colour(k)"
drawSliding = ", for [k = 1:2] '' using (unitBefore * column(before)):(unit * of(material[k], 'sliding_'.quantity)) \
        with lines linewidth 2 dashtype 2 linecolor rgb '#000000'"
# An error of both materials and what the test allows, beside the legend of all panels. Set: error, allowed.
allowed = "allowed_error_percent"
drawError = "set key top right; plot \
    keyentry with lines linewidth 2 linecolor rgb '#777777' title 'theory', \
    for [k = 1:2] table(test) using (unitBefore * column(before)):(of(material[k], error)) with points \
        pointtype symbol(k) pointsize size(k) linecolor rgb colour(k) title material[k].', simulated', \
    for [sign = -1:1:2] '' using (unitBefore * column(before)):(sign * of(material[2], allowed)) with lines \
        linewidth 1.5 dashtype 3 linecolor rgb '#777777' title sign > 0 ? 'allowed error' : ''"
slidingEntry = ", keyentry with lines linewidth 2 dashtype 2 linecolor rgb '#000000' title 'sliding throughout'"

# Tests 1 and 2 ---------------------------------------------------------------------------------------------------

error = "error_of_force_percent_of_largest"
unitBefore = 1e6
quantity = "force_N"
unit = 1e-3
do for [test = 1:2] {
    material[1] = test == 1 ? "glass" : "aluminium alloy"
    material[2] = test == 1 ? "limestone" : "magnesium alloy"
    set output chart(test)
    set multiplot layout 1, 3 title test == 1 ? "Test 1: elastic normal impact of two spheres" : \
        "Test 2: elastic normal impact of a sphere on a rigid plane"
    set xrange [0:*]
    set yrange [0:*]
    set ylabel "normal force (kN)"
    before = "time_s"
    set xlabel "time (µs)"
    eval drawQuantity
    set xlabel "overlap (µm)"
    plot for [k = 1:2] table(test) using (1e6 * of(material[k], 'theory_overlap_m')):(1e-3 * of(material[k], 'theory_force_N')) \
             with lines linewidth width(k) linecolor rgb colour(k), \
         for [k = 1:2] '' using (1e6 * of(material[k], 'simulated_overlap_m')):(1e-3 * of(material[k], 'simulated_force_N')) \
             with points pointtype symbol(k) pointsize size(k) linecolor rgb colour(k)
    set xlabel "time (µs)"
    set ylabel "error of the force (% of the largest)"
    set yrange [-0.2:0.4]
    eval drawError
    unset multiplot
}

# Test 3 ----------------------------------------------------------------------------------------------------------

test = 3
unitBefore = 1
before = "given_restitution"
material[1] = "aluminium oxide"
material[2] = "cast iron"
set output chart(test)
set multiplot layout 1, 2 title "Test 3: normal impact on a rigid plane, restitution"
set xlabel "given restitution"
set xrange [0:1.05]
set ylabel "simulated restitution"
set yrange [0:1.05]
unset key
plot x with lines linewidth 2 linecolor rgb "#777777", \
     for [k = 1:2] table(test) using "given_restitution":(of(material[k], "simulated_restitution")) with points \
         pointtype symbol(k) pointsize size(k) linecolor rgb colour(k)
set ylabel "error (%)"
set yrange [-0.05:0.1]
error = "error_percent"
eval drawError
unset multiplot

# Tests 4 to 8 ----------------------------------------------------------------------------------------------------

# The error of the spin, in the third panel.
drawErrorOfSpin = "set ylabel 'error of the spin (% of the slip taken / r)'; set yrange [-0.7:1.9]; eval drawError.slidingEntry"
error = "error_of_spin_percent"
allowed = "allowed_error_of_spin_percent"

test = 4
material[1] = "aluminium oxide"
material[2] = "aluminium alloy"
before = "incidence_deg"
set output chart(test)
set multiplot layout 1, 3 title "Test 4: oblique impact on a rigid plane at 3.9 m/s"
set xlabel "angle of incidence, from the normal (°)"
set xrange [0:90]
set xtics 15
set ylabel "tangential restitution"
set yrange [0.55:1]
unset key
restitution(k, way) = of(material[k], way."_tangential_speed_m/s") / column("tangential_speed_m/s")
plot for [k = 1:2] table(test) using before:(restitution(k, "theory")) with lines linewidth width(k) linecolor rgb colour(k), \
     for [k = 1:2] '' using before:(restitution(k, "simulated")) with points pointtype symbol(k) pointsize size(k) \
         linecolor rgb colour(k), \
     '' using before:(restitution(1, "sliding")) with lines linewidth 2 dashtype 2 linecolor rgb "#000000", \
     computed using "incidence_deg":"tangential_restitution" with points pointtype 2 pointsize 1 linecolor rgb "#009E73", \
     measured using "incidence_deg":(stringcolumn("quantity") eq "e_t" ? column("value") : NaN) with points pointtype 7 \
         pointsize 1 linecolor rgb "#000000"
quantity = "rebound_of_contact_deg"
unit = 1
set ylabel "rebound of the contact point (°)"
set yrange [-30:90]
eval drawQuantity.drawSliding
slidingOnly = slidingEntry
slidingEntry = slidingOnly.", keyentry with points pointtype 7 pointsize 1 linecolor rgb '#000000' title 'oxide, measured', \
    keyentry with points pointtype 2 pointsize 1 linecolor rgb '#009E73' title 'oxide, computed in the paper'"
eval drawErrorOfSpin
slidingEntry = slidingOnly
unset multiplot

test = 5
material[1] = "steel"
material[2] = "polyethylene"
before = "tangential_speed_m/s"
set output chart(test)
set multiplot layout 1, 3 title "Test 5: oblique impact on a rigid plane at a normal speed of 5 m/s"
set xlabel "tangential speed before (m/s)"
set xrange [0:25]
set xtics 5
quantity = "tangential_speed_m/s"
set ylabel "tangential speed after (m/s)"
set yrange [0:25]
eval drawQuantity.drawSliding
quantity = "spin_rad/s"
unit = 1e-6
set ylabel "spin after (10^6 rad/s)"
set yrange [0:1]
eval drawQuantity.drawSliding
eval drawErrorOfSpin
unset multiplot

before = "spin_rad/s"
unit = 1
set xlabel "spin before (rad/s)"
array other = ["on a rigid plane", "and one like it, with the same spin", "on one five times as large, held"]
do for [test = 6:8] {
    material[1] = "aluminium alloy"
    material[2] = test == 7 ? "copper" : "nylon"
    set output chart(test)
    set multiplot layout 1, 3 title sprintf("Test %d: a spinning sphere %s; normal speed 0.2 m/s", test, other[test - 5])
    set xrange [0:12]
    set xtics 3
    quantity = "tangential_speed_m/s"
    set ylabel "tangential speed after (m/s)"
    set yrange [0:0.15]
    eval drawQuantity.drawSliding
    quantity = "spin_rad/s"
    set ylabel "spin after (rad/s)"
    set yrange [-1:10]
    eval drawQuantity.drawSliding
    eval drawErrorOfSpin
    unset multiplot
}
