#!/usr/bin/env bash
# Plans a mix of shipped problems, replays every plan with `check --mujoco`, and prints the table of
# docs/mujoco.md: some minutes of one core.
#   scripts/mujoco_table.sh [PREHENSILE]
set -euo pipefail
cd "$(dirname "$0")/.."
prehensile=$(realpath "${1:-build/release/prehensile}")
problems=(published/square_{06,16,30,37} published/tee_{08,11,16,21,37} paper/{slide,pivot,roll}
  ycb/{bar,box,can}_{franka,robotiq} bracket slide_then_pivot confined/{tee_90,post_in_the_way}
  tilted_hand)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

echo "| problem | pushes | off mm | off deg | force % |"
echo "|---|---|---|---|---|"
for problem in "${problems[@]}"; do
  "$prehensile" plan "problems/$problem.yaml" -o "$work/plan.json" > /dev/null
  # Exit code 1 is an answer: MuJoCo differs.
  "$prehensile" check "$work/plan.json" --mujoco > "$work/out" || [ $? = 1 ]
  # Where the last push ends, and of all pushes the force that differs most. Columns are counted
  # from the end, for names of pushers have spaces.
  awk -v problem="$problem" '
    / added deg / { reading = 1; next }
    reading && $1 ~ /^[0-9]+$/ && NF > 9 {
      ++pushes; mm = $(NF - 8); deg = $(NF - 7)
      if ($(NF - 2) ^ 2 >= force ^ 2) force = $(NF - 2)
    }
    END {
      if (!pushes) { print "error: no push in the report of " problem > "/dev/stderr"; exit 2 }
      printf "| `%s` | %d | %s | %s | %s |\n", problem, pushes, mm, deg, force
    }' "$work/out"
done
