# Fields at one place over the width of the kernel, from the table of Tools/coarse-grain --plateau-m.
#   gnuplot -c Tools/coarse-grain-plateau.gp TABLE.csv OUTPUT_WITHOUT_SUFFIX
if (ARGC < 2) exit error "give TABLE.csv OUTPUT_WITHOUT_SUFFIX"
load system("dirname '".ARG0."'")."/../Drivers/Shared/chart.gp"
set output ARG2.".png"
set multiplot layout 2,1
set logscale x
set autoscale xfix
set lmargin 11
set rmargin 4
set key off
set ylabel "density (kg/m^3)"
plot ARG1 using (1e3*column("width_m")):(column("density_kg_per_m3")) with linespoints linestyle 1
set xlabel "width of the kernel (mm)"
set ylabel "pressure of contacts (Pa)"
plot ARG1 using (1e3*column("width_m")):((column("contact_stress_xx_Pa") + column("contact_stress_yy_Pa") + column("contact_stress_zz_Pa")) / 3) with linespoints linestyle 2
unset multiplot
