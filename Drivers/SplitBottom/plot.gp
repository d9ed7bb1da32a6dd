# Angular velocity at the surface over the distance from the axis, with the error function fitted to it.
#   gnuplot -c Drivers/SplitBottom/plot.gp FOLDER [DISC]    FOLDER/LAYERS/profile.csv; writes FOLDER/profile.png
# DISC: radius of the disc, mm, 24 if left out.
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
disc = ARGC > 1 ? real(ARG2) : 24.0
runs = system("cd '".ARG1."' && ls -d */profile.csv | xargs -n 1 dirname | sort -V")
# The surface: at each distance, the uppermost point with a solid fraction above 0.3, half of that inside.
surface(run) = "< awk -F, 'NR > 1 && $3 > 0.3 { if (!($1 in top) || $2 > top[$1]) top[$1] = $2; of[$1, $2] = $4 } END { for (r in top) print r \",\" top[r] \",\" of[r, top[r]] }' '".ARG1."/".run."/profile.csv' | sort -t, -g"
profile(r, centre, width) = 0.5 - 0.5 * erf((r - centre) / width)
array Centre[words(runs)]
array Width[words(runs)]
set fit quiet nologfile
do for [k = 1:words(runs)] {
    c = disc
    w = 0.2 * disc
    fit profile(x, c, w) surface(word(runs, k)) using (1e3 * $1):3 via c, w
    stats surface(word(runs, k)) using (1e3 * $2) nooutput
    Centre[k] = c
    Width[k] = w
    print sprintf("%s: height %.1f mm, centre %.2f +- %.2f mm, width %.2f +- %.2f mm, rms %.3f", \
                  word(runs, k), STATS_mean, c, c_err, w, w_err, FIT_STDFIT)
}
set output ARG1."/profile.png"
set xlabel "distance from the axis (mm)"
set ylabel "angular velocity at the surface, of the disc's"
set yrange [-0.05:1.1]
set arrow from disc, graph 0 to disc, graph 1 nohead linestyle 4
set label "split" at disc, graph 0.95 offset 0.5, 0
plot for [k = 1:words(runs)] surface(word(runs, k)) using (1e3 * $1):3 with points linestyle k title word(runs, k)." layers", \
     for [k = 1:words(runs)] profile(x, Centre[k], Width[k]) linestyle k notitle
