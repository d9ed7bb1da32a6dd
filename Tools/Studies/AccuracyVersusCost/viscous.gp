# Schemes of viscous bridges against closed forms, from the table of Tools/Studies/accuracy-versus-cost --viscous.
#   gnuplot -c Tools/Studies/AccuracyVersusCost/viscous.gp VISCOUS.CSV OUTPUT_WITHOUT_SUFFIX
if (ARGC < 2) exit error "give VISCOUS.CSV OUTPUT_WITHOUT_SUFFIX"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
set datafile commentschars "#"
table = ARG1
array schemes = ["gap", "implicit", "explicit"]
array titles = ["gap scheme (the default)", "implicit", "explicit"]
array colours = ["#009E73", "#0072B2", "#D55E00"]
array symbols = [7, 5, 9]

# The worst of all radii and viscosities of a scheme, Stokes number and way.
worst(scheme) = sprintf("< awk -F, 'function most(a, b) { return a > b ? a : b } $1 == \"%s\" { k = $2 \",\" $3; t[k] = most(t[k], $7); e[k] = most(e[k], $8); s[k] = most(s[k], most($7, $9)) } END { for (k in t) print k \",\" t[k] \",\" e[k] \",\" s[k] }' '%s' | sort -t, -k1,1g -k2,2g", scheme, table)
ofStokes(scheme, stokes) = sprintf("%s | awk -F, '$1 == %s'", worst(scheme), stokes)
place(value) = floor(2 * log10(value) + 0.5)  # 0.01, 0.03, 0.1 ... one apart; 5 is where 3 would be
cost(scheme, column) = real(system(sprintf("awk -F, '$1 == \"%s\" { print $%d; exit }' '%s'", scheme, column, table)))

set terminal pngcairo size 1700,1050 fontscale 0.95 linewidth 1.3
set output ARG2.".png"
set multiplot layout 2,3
set palette defined (-6 "#009E73", -4 "#56B4E9", -3 "#F0E442", -2 "#E69F00", -1 "#D55E00", 0 "#000000")
set cbrange [-6:0]
set cbtics ("10^{-6}" -6, "10^{-5}" -5, "10^{-4}" -4, "1e-3" -3, "1 %%" -2, "10 %%" -1, "100 %%" 0)
set xrange [-4.5:2.5]
set yrange [-2.5:6.5]
set xtics ("0.01" -4, "0.1" -2, "1" 0, "10" 2)
set ytics ("0.1" -2, "1" 0, "10" 2, "100" 4, "1000" 6)
set xlabel "way of a step over the roughness, v {/Symbol D}t / {/Symbol e}"
do for [k = 1:3] {
    set title titles[k].": error of v_{touch} / v, or of the gap of a stop"
    set ylabel (k == 1 ? "Stokes number" : "")
    # Where the resistance at the roughness changes the speed by all of it in a step.
    set arrow 1 from -2.5,-2.5 to 2.5,2.5 nohead front dashtype 2 linewidth 2 linecolor rgb "#ffffff"
    set label 1 "K {/Symbol D}t = {/Symbol e}" at -1.3,-1.6 front textcolor rgb "#ffffff"
    plot worst(schemes[k]) using (place($2)):(place($1)):($5 > 1e-6 ? log10($5) : -6) with image notitle
}
unset arrow 1
unset label 1
set logscale xy
set xrange [0.008:13]
set xtics auto
set ytics auto
set format y "10^{%T}"
set key bottom right
do for [stokes in "10 100"] {
    set title "St = ".stokes.": error of v_{touch} (filled) and of e_n (open)"
    set ylabel (stokes eq "10" ? "error / v" : "")
    set yrange [1e-12:1]
    plot for [k = 1:3] ofStokes(schemes[k], stokes) using 2:3 with linespoints pointtype symbols[k] pointsize 1.6 linewidth 2 linecolor rgb colours[k] title titles[k], \
         for [k = 1:3] ofStokes(schemes[k], stokes) using 2:4 with linespoints pointtype symbols[k]-1 pointsize 1.6 dashtype 3 linecolor rgb colours[k] notitle, \
         1e-9 with lines dashtype 2 linecolor rgb "#000000" title "round-off of 10^4 steps"
}
unset logscale
set title "cost of a bridge and step, without its capillary force"
set format y "%g"
set ylabel "ns"
set xlabel ""
set yrange [0:*]
set xrange [0.4:3.6]
set xtics ("gap" 1, "implicit" 2, "explicit" 3)
set style fill solid 0.9
set boxwidth 0.35
set key top right
set samples 3
plot "+" using (column(0) + 0.8):(cost(schemes[int(column(0)) + 1], 10)) with boxes linecolor rgb "#E69F00" title "normal", \
     "+" using (column(0) + 1.2):(cost(schemes[int(column(0)) + 1], 11)) with boxes linecolor rgb "#56B4E9" title "and against slip and rolling"
unset multiplot
