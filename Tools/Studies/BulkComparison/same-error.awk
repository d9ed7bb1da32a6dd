# Of a table bulk-peers.csv of compare-bulk.sh: what the same error of a bulk figure takes, theirs over ours (pendular-default), for
# errors of 1, 2 and 5 %. Of each code the fastest step counts that is not refuted, that is, lost no grains and does not deviate by
# more than the error and more than two standard errors; errors grow with the step, so that a smaller one that is refuted is chance.
# "all" is the one that holds for all figures of the scene.
# The range: theirs judged by three standard errors and ours by one, and the other way round, with the scatter of the times.
function absolute(x) { return x < 0 ? -x : x }
function larger(a, b) { return a > b ? a : b }
function holds(row, figure, percent, errors,   f, at) {
    for (f = 1; f <= figuresOf[sceneOf[row]]; f++) {
        if (figure != "all" && figure != figureOf[sceneOf[row], f]) continue
        at = row SUBSEP figureOf[sceneOf[row], f]
        if (deviation[at] == "nan" || absolute(deviation[at]) > larger(percent, errors * spread[at])) return 0
    }
    return 1
}
# The row of that step.
function fastest(scene, code, figure, percent, errors,   k, best) {
    for (k = 1; k <= rowsOf[scene, code]; k++) {
        if (!holds(rowOf[scene, code, k], figure, percent, errors)) continue
        if (best == "" || timeOf[rowOf[scene, code, k]] < timeOf[best]) best = rowOf[scene, code, k]
    }
    return best
}
function resolved(row, figure,   f, at, most) {
    for (f = 1; f <= figuresOf[sceneOf[row]]; f++) {
        if (figure != "all" && figure != figureOf[sceneOf[row], f]) continue
        at = row SUBSEP figureOf[sceneOf[row], f]
        most = larger(most, 2 * spread[at])
    }
    return most
}
/^#/ || $1 == "scene" { next }
{
    row = $1 SUBSEP $2 SUBSEP $3
    if (!(row in sceneOf)) {
        sceneOf[row] = $1; stepOf[row] = $3; timeOf[row] = $7; scatterOf[row] = $8
        rowOf[$1, $2, ++rowsOf[$1, $2]] = row
        if (!($1 in figuresOf)) scenes[++sceneCount] = $1
    }
    if (!(($1, $9) in known)) { known[$1, $9] = 1; figureOf[$1, ++figuresOf[$1]] = $9 }
    deviation[row, $9] = $12; spread[row, $9] = $13
}
END {
    print "scene,figure,error_percent,peer,step_over_rayleigh_time,step_of_peer_over_rayleigh_time,processor_s_per_s,processor_s_per_s_of_peer,theirs_over_ours,lowest,highest,two_standard_errors_percent"
    for (s = 1; s <= sceneCount; s++) for (f = 1; f <= figuresOf[scenes[s]] + (figuresOf[scenes[s]] > 1); f++) {
        figure = f > figuresOf[scenes[s]] ? "all" : figureOf[scenes[s], f]
        for (e = split("1 2 5", percents, " "); e >= 1; e--) for (p = split("liggghts lammps", peers, " "); p >= 1; p--) {
            if (!((scenes[s], peers[p]) in rowsOf)) continue
            for (errors = 1; errors <= 3; errors++) {
                ours[errors] = fastest(scenes[s], "pendular-default", figure, percents[e], errors)
                theirs[errors] = fastest(scenes[s], peers[p], figure, percents[e], errors)
            }
            if (ours[2] == "" || theirs[2] == "") continue
            ratio = timeOf[theirs[2]] / timeOf[ours[2]]
            scatter = sqrt((scatterOf[theirs[2]] / timeOf[theirs[2]]) ^ 2 + (scatterOf[ours[2]] / timeOf[ours[2]]) ^ 2)
            printf "%s,%s,%s,%s,%s,%s,%.4g,%.4g,%.2f,%.2f,%.2f,%.2g\n", scenes[s], figure, percents[e], peers[p], stepOf[ours[2]], stepOf[theirs[2]],
                timeOf[ours[2]], timeOf[theirs[2]], ratio, timeOf[theirs[3]] / timeOf[ours[1]] * (1 - scatter), timeOf[theirs[1]] / timeOf[ours[3]] * (1 + scatter),
                larger(resolved(ours[2], figure), resolved(theirs[2], figure))
        }
    }
}
