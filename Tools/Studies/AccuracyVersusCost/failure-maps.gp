# Where the liquid bridge laws fail, from the table of Tools/Studies/accuracy-versus-cost --failure-maps.
#   gnuplot -c failure-maps.gp TABLE.csv OUTPUT.png
# A panel for each law; the black line surrounds where the rupture distance is wrong by more than 20 %.
if (ARGC < 2) exit error "give TABLE.csv OUTPUT.png"

set encoding utf8
set terminal pngcairo size 1060,1000 fontscale 0.68
set output ARG2

names = system(sprintf("awk -F, '!/^#/ && $1 != \"law\" && $1 != last { print last = $1 }' '%s'", ARG1))
# Columns log10 V*, theta, region, error of the force, error of the rupture distance; an empty line after each volume.
rows(law) = sprintf("< awk -F, -v law='%s' '$1 == law { if ($2 != last) print \"\"; last = $2; print $2, $3, $4, $5, $6 }' '%s'", \
    law, ARG1)

# Colours of Okabe and Ito, which colour-blind readers tell apart.
array colours[6] = ["#009E73", "#F0E442", "#D55E00", "#CC79A7", "#000000", "#DDDDDD"]
array meanings[6] = ["within 5 %", "5 to 20 %", "beyond 20 %", "wrong sign", "not finite", "refused at set-up"]
set palette maxcolors 6 defined (0 colours[1], 1 colours[2], 2 colours[3], 3 colours[4], 4 colours[5], 5 colours[6])
set cbrange [-0.5:5.5]
unset colorbox
unset key
set xrange [-9:1]
set yrange [0:180]
set xtics ("10^{-9}" -9, "10^{-6}" -6, "10^{-3}" -3, "1" 0)
set ytics 30
set tics front out nomirror

set multiplot layout 4,4 margins 0.05,0.99,0.06,0.965 spacing 0.03,0.06
do for [i = 1:words(names)] {
    law = word(names, i)
    title = law[13:*]
    if (strstrt(title, "+") > 0) { title = title[1:strstrt(title, "+") - 1].", solving outside" }
    set title title offset 0,-0.7
    set xlabel (i > 12 ? "{/:Italic V}*" : "") offset 0,0.5
    set ylabel (i % 4 == 1 ? "contact angle (deg)" : "") offset 1.5,0
    set table $outline
    set contour base
    set cntrparam levels discrete 20
    unset surface
    splot rows(law) using 1:2:($3 == 5 ? NaN : abs($5))
    unset table
    unset contour
    set surface
    set print $outline append
    print "-99 -99"  # so that there is a line, outside of the panel, where there is no outline
    unset print
    plot rows(law) using 1:2:3 with image, $outline using 1:2 with lines linewidth 1.2 linecolor rgb "black"
}
# The key takes the last place.
unset border; unset tics; unset xlabel; unset ylabel
set title "largest error of {/:Italic F}" offset 0,-0.7
set xrange [0:1]
set yrange [0:8]
plot for [k = 1:6] "+" using (0.1):(7.5 - k) every ::0::0 with points pointtype 5 pointsize 3 linecolor rgb colours[k], \
    for [k = 1:6] "+" using (0.18):(7.5 - k):(meanings[k]) every ::0::0 with labels left, \
    "+" using (0.02):(0.5):(0.14):(0) every ::0::0 with vectors nohead linewidth 1.2 linecolor rgb "black", \
    "+" using (0.18):(0.5):("rupture distance 20 % wrong") every ::0::0 with labels left
unset multiplot
