#!/usr/bin/env bash
# Makes README's table of success rates from the committed results of the full suite, between its
# two marks; with --check only says whether README is up to date.
set -euo pipefail
cd "$(dirname "$0")/.."

summary=benchmarks/results/full_summary.csv
new=$(mktemp)
trap 'rm -f "$new"' EXIT

# Families are put together by the first word of their name. Interval: Wilson's, 95 %.
table() {
  awk -F, '
    NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    $column["family"] == "all" || $column["planner"] != "push" { next }
    {
      group = $column["family"]; sub(/_.*/, "", group)
      # Limits and obstacles may leave no plan, whatever the goal.
      kind = $column["family"] ~ /_random$|^(angle|obstacles)_/ ? "random" : "made"
      if (!(group in seen)) { seen[group] = 1; order[++groups] = group }
      n[group, kind] += $column["runs"]; solved[group, kind] += $column["solved"]
      infeasible[group, kind] += $column["infeasible"]
      part[group, kind] += $column["part_of_margin"]; nominal[group, kind] += $column["nominal_only"]
      all += $column["runs"]
      ms = 1000 * $column["time_median"]
      if (!(group in low) || ms < low[group]) low[group] = ms
      if (!(group in high) || ms > high[group]) high[group] = ms
    }
    function wilson(k, n, sign,   z, p, d) {
      z = 1.959964; p = k / n; d = 1 + z * z / n
      return 100 * (p + z * z / (2 * n) + sign * z * sqrt(p * (1 - p) / n + z * z / (4 * n * n))) / d
    }
    function words(group) {
      return group == "angle" ? "limits of the angle" : group == "pad" ? "pads not round" \
             : group == "pushers" ? "1 to 6 pushers" : group == "points" ? "point pushers alone" \
             : group == "friction" ? "low, high friction" : group == "heavy" ? "near the limit of grip" \
             : group == "tight" ? "tight goals" : group == "mesh" ? "meshes" : group == "ycb" ? "YCB objects" \
             : group
    }
    function less(group, kind) {
      return part[group, kind] + 0 "; " nominal[group, kind] + 0
    }
    function share(group,   k, m) {
      m = n[group, "made"]; k = solved[group, "made"]
      if (m == 0) return "| | | |"
      return sprintf("| %d of %d | %.1f-%.1f %% | %s |", k, m, wilson(k, m, -1), wilson(k, m, 1),
                     less(group, "made"))
    }
    function others(group,   m) {
      m = n[group, "random"]
      if (m == 0) return " | | | |"
      return sprintf(" %d of %d | %s | %d | %d |", solved[group, "random"], m, less(group, "random"),
                     infeasible[group, "random"], m - solved[group, "random"] - infeasible[group, "random"])
    }
    END {
      print "| problems | solved | 95 % | part; nominal | random goals: solved | part; nominal" \
            " | proved impossible | open | median ms |"
      print "|---|---|---|---|---|---|---|---|---|"
      for (i = 1; i <= groups; ++i) {
        group = order[i]
        time = sprintf("%.2g", low[group])
        if (sprintf("%.2g", high[group]) != time) time = time "-" sprintf("%.2g", high[group])
        print "| " words(group) " " share(group) others(group) " " time " |"
      }
      printf "\n%d problems, one run each.\n", all
    }' "$summary"
}

awk '/<!-- results: begin/ { print; exit } { print }' README.md > "$new"
table >> "$new"
awk '/<!-- results: end/ { found = 1 } found { print }' README.md >> "$new"
if cmp -s "$new" README.md; then
  exit 0
fi
if [ "${1:-}" = --check ]; then
  echo "error: README's table is not what $summary says: run scripts/readme_results.sh" >&2
  diff README.md "$new" >&2 || exit 1
fi
cp "$new" README.md
