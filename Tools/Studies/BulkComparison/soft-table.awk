# Of the rows of soften-bulk.sh (scene,code,modulus or stiffness,seed,step_s,survived,time,figure,value,...): means and standard errors
# over the seeds, and the deviation of each mean from that of the same code at its hardest, with the standard error of both.
function mean(at,   i, s) { for (i = 1; i <= n[at]; i++) s += v[at, i]; return s / n[at] }
function error(at, m,   i, s) { for (i = 1; i <= n[at]; i++) s += (v[at, i] - m) ^ 2; return n[at] > 1 ? sqrt(s / (n[at] * (n[at] - 1))) : "nan" }
function median(at,   i, j, t) {
    for (i = 1; i <= runs[at]; i++) for (j = i + 1; j <= runs[at]; j++) if (cost[at, j] < cost[at, i]) { t = cost[at, i]; cost[at, i] = cost[at, j]; cost[at, j] = t }
    return runs[at] % 2 ? cost[at, (runs[at] + 1) / 2] : (cost[at, runs[at] / 2] + cost[at, runs[at] / 2 + 1]) / 2
}
{
    run = $1 SUBSEP $2 SUBSEP $3
    if (!(run in runs)) { order[++count] = run; scene[count] = $1; code[count] = $2; hardness[count] = $3; step[count] = $5 }
    runs[run]++
    alive[run] += $6
    if (!$6) next
    cost[run, ++times[run]] = $7
    if (!(($1, $2) in hardest) || $3 + 0 > hardest[$1, $2] + 0) hardest[$1, $2] = $3
    for (k = 8; k < NF; k += 2) {
        if (!(($1, $k) in seen)) { seen[$1, $k] = 1; figures[$1] = figures[$1] " " $k }
        at = run SUBSEP $k
        v[at, ++n[at]] = $(k + 1)
    }
}
END {
    print "scene,code,modulus_Pa_or_stiffness,step_s,runs,runs_that_survived,processor_s,figure,mean,standard_error,deviation_percent,deviation_standard_error_percent"
    for (c = 1; c <= count; c++) {
        run = order[c]
        all = split(figures[scene[c]], names, " ")
        for (f = 1; f <= all; f++) {
            head = sprintf("%s,%s,%s,%s,%d,%d", scene[c], code[c], hardness[c], step[c], runs[run], alive[run])
            if (alive[run] < runs[run]) { print head ",nan," names[f] ",nan,nan,nan,nan"; continue }
            at = run SUBSEP names[f]; to = scene[c] SUBSEP code[c] SUBSEP hardest[scene[c], code[c]] SUBSEP names[f]
            m = mean(at); reference = mean(to); own = error(at, m); other = error(to, reference)
            deviation = 100 * (m / reference - 1)
            spread = at == to || own == "nan" || other == "nan" ? "nan" : sprintf("%.2g", 100 * m / reference * sqrt((own / m) ^ 2 + (other / reference) ^ 2))
            printf "%s,%.4g,%s,%.5g,%s,%.3g,%s\n", head, median(run), names[f], m, own == "nan" ? own : sprintf("%.2g", own), deviation, at == to ? 0 : spread
        }
    }
}
