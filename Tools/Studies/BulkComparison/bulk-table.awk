# Of the rows of Tools/Studies/BulkComparison/compare-bulk.sh (scene,code,step over Rayleigh's time or share,seed,step_s,survived,s of the processor for a
# second,figure,value,...): means and standard errors over the seeds, and the mean deviation from the run of the same code (each
# variant of Pendular: of its default) at its smallest step from the same start, with the standard error of that mean.
function mean(at,   i, s) { for (i = 1; i <= n[at]; i++) s += v[at, i]; return s / n[at] }
function error(at, m,   i, s) { for (i = 1; i <= n[at]; i++) s += (v[at, i] - m) ^ 2; return n[at] > 1 ? sqrt(s / (n[at] * (n[at] - 1))) : "nan" }
function median(at,   i, j, t) {
    for (i = 1; i <= runs[at]; i++) for (j = i + 1; j <= runs[at]; j++) if (cost[at, j] < cost[at, i]) { t = cost[at, i]; cost[at, i] = cost[at, j]; cost[at, j] = t }
    return runs[at] % 2 ? cost[at, (runs[at] + 1) / 2] : (cost[at, runs[at] / 2] + cost[at, runs[at] / 2 + 1]) / 2
}
function scatter(at,   i, s, square) { for (i = 1; i <= runs[at]; i++) { s += cost[at, i]; square += cost[at, i] ^ 2 } return runs[at] > 1 ? sqrt((square / runs[at] - (s / runs[at]) ^ 2 > 0 ? square / runs[at] - (s / runs[at]) ^ 2 : 0) / (runs[at] - 1)) : 0 }
# Each variant of Pendular against its default; the others against themselves.
function reference(scene, code) { return scene SUBSEP first[scene, code ~ /^pendular/ ? "pendular-default" : code] }
{
    run = $1 SUBSEP $2 "," $3
    if (!(run in runs)) { order[++count] = run; scene[count] = $1; code[count] = $2; share[count] = $3; step[count] = $5 }
    if (!(($1, $2) in first)) first[$1, $2] = $2 "," $3
    cost[run, ++runs[run]] = $7
    alive[run] += $6
    for (k = 8; k < NF; k += 2) {
        if (!(($1, $k) in seen)) { seen[$1, $k] = 1; figures[$1] = figures[$1] " " $k }
        at = run SUBSEP $k
        v[at, ++n[at]] = $(k + 1)
    }
}
END {
    for (c = 1; c <= count; c++) {
        run = reference(scene[c], code[c])
        if (alive[run] == runs[run]) continue
        split(first[scene[c], code[c] ~ /^pendular/ ? "pendular-default" : code[c]], parts, ",")
        printf "%s: %s lost grains at its smallest step, %s of Rayleigh's time, which its others are compared with; begin with a smaller one.\n", scene[c], parts[1], parts[2] >"/dev/stderr"
        exit 1
    }
    print "scene,code,step_over_rayleigh_time_or_share,step_s,runs,runs_that_survived,processor_s_per_s,processor_s_per_s_standard_error,figure,mean,standard_error,deviation_percent,deviation_standard_error_percent"
    for (c = 1; c <= count; c++) {
        run = order[c]
        all = split(figures[scene[c]], names, " ")
        for (f = 1; f <= all; f++) {
            head = sprintf("%s,%s,%s,%.4g,%d,%d,%.4g,%.2g,%s", scene[c], code[c], share[c], step[c], runs[run], alive[run], median(run), scatter(run), names[f])
            at = run SUBSEP names[f]; to = reference(scene[c], code[c]) SUBSEP names[f]
            if (alive[run] < runs[run]) { print head ",nan,nan,nan,nan"; continue }
            m = mean(at)
            n["ratio"] = n[at]
            for (i = 1; i <= n[at]; i++) v["ratio", i] = 100 * (v[at, i] / v[to, i] - 1)
            deviation = mean("ratio")
            printf "%s,%.5g,%.2g,%.3g,%.2g\n", head, m, error(at, m), deviation, error("ratio", deviation)
        }
    }
}
