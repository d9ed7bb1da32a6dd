# What a scene pays for, as bars with the bytes of a grain.   gnuplot -c features.gp TABLE.csv CHART.png
if (ARGC < 2) exit error "give TABLE.csv CHART.png"
set datafile separator ";"
set datafile commentschars "#"
set terminal pngcairo size 1100,620 fontscale 1.2
set output ARG2
set style fill solid 0.9
set boxwidth 0.7
set ylabel "ns a grain and step, one thread"
set yrange [0:*]
set offsets 0.6, 0.6, 6, 0
set grid ytics linecolor rgb "#cccccc"
set xtics rotate by -25 font ",11"
set rmargin 10
unset key
plot ARG1 every ::1 using 0:4:xtic(1) with boxes linecolor rgb "#D55E00", \
     ARG1 every ::1 using 0:4:(sprintf("%.0f B", column(6))) with labels offset 0,0.6
