# Friction laws against the exact contact with partial slip, from the tables of Tools/Studies/accuracy-versus-cost --friction.
#   gnuplot -c Tools/Studies/AccuracyVersusCost/friction.gp FOLDER    draws FOLDER/laws.png and FOLDER/random-walks.png
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../../../Drivers/Shared/chart.gp"
set datafile commentschars "#"
folder = ARG1
laws = "Mindlin|Mindlin (factor 1)|MindlinSecant|SlidingFriction|increments without rescaling|MindlinIncremental (factor 1)|MindlinIncremental|two springs|MindlinPartialSlip|eight springs"
count = 10
name(k) = system(sprintf("echo '%s' | cut -d'|' -f%d", laws, k))
array titles[count]
do for [k = 1:count] { titles[k] = name(k) }
array colours[count] = ["#D55E00", "#D55E00", "#CC79A7", "#E69F00", "#56B4E9", "#0072B2", "#0072B2", "#009E73", "#009E73", "#777777"]
array dashes[count] = [1, 2, 1, 1, 2, 2, 1, 2, 1, 1]
array symbols[count] = [7, 6, 9, 5, 4, 6, 7, 6, 7, 9]

cells(file, law) = sprintf("< awk -F, '$1 == \"%s\"' '%s/%s.csv'", law, folder, file)
ofPopulation(law, population) = sprintf("%s | awk -F, '$2 == \"%s\"'", cells("laws", law), population)

set terminal pngcairo size 1700,1050 fontscale 0.85 linewidth 1.3
set output folder."/laws.png"
set multiplot layout 2,3
set key off
set logscale xy
set xrange [2:60]
set yrange [0.2:100]
set format y "%g %%"
set xtics (2, 5, 10, 20, 50)
set xlabel "cost of a contact's friction (ns)"
do for [population in "'constant load' 'swinging load' 'random walk'"] {
    set title "force, ".population
    set ylabel "rms error over {/Symbol m} N"
    plot for [k = 1:count] ofPopulation(titles[k], population) using 14:4 with points pointtype symbols[k] pointsize 2 linecolor rgb colours[k]
}
set title "impacts"
set ylabel "rms error of {/:Italic e}_t"
set yrange [0.3:30]
plot for [k = 1:count] ofPopulation(titles[k], "impacts") using 14:11 with points pointtype symbols[k] pointsize 2 linecolor rgb colours[k]
unset logscale
set xtics 1
set format y "%g"
set title "impacts, {/Symbol n} = 0.3"
set xlabel "slip over speed of approach, {/Symbol y}"
set ylabel "tangential restitution"
set xrange [0:7]
set yrange [0.3:1]
set key bottom right samplen 2 font ",9"
plot cells("impacts", "exact") using 2:3 with lines linewidth 4 linecolor rgb "#000000" title "exact", \
     for [k = 1:count] cells("impacts", titles[k]) using 2:3 with lines linewidth 1.5 dashtype dashes[k] linecolor rgb colours[k] title titles[k]
set logscale xy
set title "constant load"
set xlabel "amplitude over that of full slip"
set ylabel "loss of a cycle"
set xrange [0.02:2]
set xtics (0.02, 0.1, 0.5, 1, 2)
set yrange [1e-6:10]
set format y "10^{%T}"
set key top left
plot cells("loss", "exact") using 2:3 with lines linewidth 4 linecolor rgb "#000000" title "exact", \
     for [k = 1:count] cells("loss", titles[k]) using 2:($3 > 1e-9 ? $3 : NaN) with points pointtype symbols[k] pointsize 0.9 linecolor rgb colours[k] title titles[k]
unset multiplot
unset logscale
unset key

# The error over random walks: green within 5 %, yellow to 10 %, red beyond.
set format y "%g"
set terminal pngcairo size 1700,720 fontscale 0.75
set output folder."/random-walks.png"
set multiplot layout 2,5 margins 0.05,0.93,0.09,0.94 spacing 0.015,0.09
set palette defined (0 "#009E73", 5 "#F0E442", 10 "#E69F00", 20 "#D55E00", 60 "#000000")
set cbrange [0:60]
set xrange [-1.05:0.35]
set yrange [-0.0475:0.9975]
set xtics ("0.1" -1, "0.3" -0.523, "1" 0)
do for [k = 1:count] {
    set title titles[k] offset 0,-0.7
    set xlabel (k > 5 ? "amplitude over full slip" : "") offset 0,0.3
    set ylabel (k % 5 == 1 ? "largest fall of the overlap" : "") offset 1,0
    if (k == count) { set colorbox; set cblabel "rms error of the force (%)" } else { unset colorbox; unset cblabel }
    plot cells("random-walks", titles[k]) using (log10($2)):3:4 with image
}
unset multiplot
