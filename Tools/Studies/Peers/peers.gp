# Speed of each code on each scene, as bars.   gnuplot -c peers.gp TABLE.csv CHART.png
if (ARGC < 2) exit error "give TABLE.csv CHART.png"
set datafile separator comma
set datafile commentschars "#"
set terminal pngcairo size 1100,620 fontscale 1.2
set rmargin 14
set output ARG2
set style data histogram
set style fill solid 0.9
set boxwidth 0.9
set ylabel "million particle steps per second, one thread"
set yrange [0:*]
set grid ytics linecolor rgb "#cccccc"
set xtics rotate by -25 font ",11"
unset key
colour(code) = code[1:8] eq "pendular" ? 0xD55E00 : 0x56B4E9
plot ARG1 every ::1 using 0:7:(colour(strcol(2))):xtic(sprintf("%s %s %d", strcol(1), strcol(2), column(3))) with boxes linecolor rgb variable, \
     ARG1 every ::1 using 0:($7 + 0.5):(sprintf("%.1f", $7)) with labels offset 0,0.3
