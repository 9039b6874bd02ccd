#!/usr/bin/env bash
# Plans a mix of shipped problems, replays every plan in MuJoCo at the speed of `check --mujoco`
# and at half of it, and prints the table of docs/mujoco.md. Takes some 20 minutes of one core.
#   scripts/mujoco_table.sh [PREHENSILE]
set -euo pipefail
cd "$(dirname "$0")/.."
prehensile=$(realpath "${1:-build/release/prehensile}")
problems=(published/square_{06,16,30,37} published/tee_{08,11,16,21,37} paper/{slide,pivot,roll}
  ycb/{bar,box,can}_{franka,robotiq} bracket slide_then_pivot confined/{tee_90,post_in_the_way}
  tilted_hand)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Of the last push: where the object ends; of all: the force that differs most. Fields are counted
# from the end, for names of pushers have spaces. "DIFFERS" is an answer: exit code 1.
numbers() {
  "$prehensile" check "$work/plan.json" --mujoco --mujoco-speed-mm-s "$1" > "$work/out" || [ $? = 1 ]
  awk '
    / added deg / { reading = 1; next }
    reading && $1 ~ /^[0-9]+$/ && NF > 9 {
      ++pushes; mm = $(NF - 8); deg = $(NF - 7)
      if ($(NF - 2) ^ 2 >= force ^ 2) force = $(NF - 2)
    }
    END { print pushes, mm, deg, force }' "$work/out"
}

echo "| problem | pushes | off mm | off deg | force % | at half the speed: off mm | off deg | force % |"
echo "|---|---|---|---|---|---|---|---|"
for problem in "${problems[@]}"; do
  "$prehensile" plan "problems/$problem.yaml" -o "$work/plan.json" > /dev/null
  full=2 half=1
  if grep -q tilted <<< "$problem"; then full=0.2 half=0.1; fi
  read -r pushes mm deg force < <(numbers $full)
  read -r _ half_mm half_deg half_force < <(numbers $half)
  echo "| \`$problem\` | $pushes | $mm | $deg | $force | $half_mm | $half_deg | $half_force |"
done
