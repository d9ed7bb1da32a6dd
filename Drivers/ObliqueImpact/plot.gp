# Restitution along the plane over the angle of incidence, and the spin, with the measurements of Kharaz et al. (2001) and
# the computed curve of Chung and Ooi (2011).
#   gnuplot -c Drivers/ObliqueImpact/plot.gp FOLDER    FOLDER: the driver's --output; writes FOLDER/{restitution,spin}.png
if (ARGC < 1) exit error "give FOLDER"
here = system("dirname '".ARG0."'")
load here."/../Shared/chart.gp"
set datafile commentschars "#"
measured = here."/kharaz-2001-measured.csv"
ofQuantity(name) = stringcolumn("quantity") eq name ? column("value") : NaN
impacts = ARG1."/impacts.csv"
of(factor, name) = abs(column("spring_factor") - factor) < 0.01 ? column(name) : NaN

set xlabel "angle of incidence, from the normal (degrees)"
set xrange [0:90]
set output ARG1."/restitution.png"
set ylabel "tangential restitution"
set yrange [0.5:1]
set key bottom right
plot impacts using "incidence_deg":(of(1, "tangential_restitution")) with lines linestyle 2 title "spring factor 1", \
     impacts using "incidence_deg":(of(2.0/3, "tangential_restitution")) with lines linestyle 1 title "spring factor 2/3", \
     here."/chung-ooi-2011-computed.csv" using "incidence_deg":"tangential_restitution" with points linestyle 3 pointtype 6 title "computed by Chung and Ooi", \
     measured using "incidence_deg":(ofQuantity("e_t")) with points linestyle 4 pointtype 7 pointsize 1.6 title "measured by Kharaz et al."

set output ARG1."/spin.png"
set ylabel "spin after the impact (rad/s)"
set yrange [0:*]
set key top right
plot impacts using "incidence_deg":(of(1, "spin_rad/s")) with lines linestyle 2 title "spring factor 1", \
     impacts using "incidence_deg":(of(2.0/3, "spin_rad/s")) with lines linestyle 1 title "spring factor 2/3", \
     measured using "incidence_deg":(-ofQuantity("spin_rad_per_s")) with points linestyle 4 pointtype 7 pointsize 1.6 title "measured by Kharaz et al."
