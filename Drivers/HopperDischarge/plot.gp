# The mass that has left over time, and the flow against Beverloo's law.
#   gnuplot -c Drivers/HopperDischarge/plot.gp FOLDER    FOLDER: the driver's --output; writes FOLDER/{discharge,flow}.png
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
curves = ARG1."/discharge.csv"
flows = ARG1."/flow.csv"

set output ARG1."/discharge.png"
set xlabel "time (s)"
set ylabel "mass that has left (g)"
set key top left
stats flows using "orifice_m" nooutput
orifices = ""
stats flows using (orifices = orifices.sprintf(" %.10g", column("orifice_m")), 0) nooutput
plot for [k = 1:words(orifices)] curves \
         using (column("orifice_m") == real(word(orifices, k)) ? column("time_s") : NaN):(1e3 * column("mass_kg")) \
         with lines linestyle 1 + (k - 1) % 3 title sprintf("orifice of %g mm", 1e3 * real(word(orifices, k)))

set output ARG1."/flow.png"
set xlabel "diameter of the orifice (mm)"
set ylabel "{/:Italic W}^{2/5} ((kg/s)^{2/5})"
set xrange [0:*]
set yrange [0:*]
set fit quiet logfile "/dev/null"
set offsets 0, 1, 0.02, 0
fit a * x + b flows using "orifice_m":(column("beverloo_kg/s")**0.4) via a, b
plot a * 1e-3 * x + b with lines linestyle 4 title "Beverloo's law, fitted", \
     flows using (1e3 * column("orifice_m")):(column("flow_kg/s")**0.4) with points linestyle 1 title "simulation"
