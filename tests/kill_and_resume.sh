#!/usr/bin/env bash
# kill_and_resume.sh <directory of the programs> <scratch directory> <kills> [<program>...]
#
# Kills the programs that march (all, or those named) at random times, resumes them until they end, and compares what
# they wrote with what a run that nothing happened to wrote: the same bytes, but for wall_seconds. Most kills are
# SIGKILL; after the others the program must have written its results.
set -u -o pipefail

programs=$1
scratch=$2
wanted=$3
shift 3
chosen=("$@")
signals=(KILL TERM KILL HUP KILL KILL INT KILL)
cases=(
  "settling_vesicle --preset-accuracy fast"
  "relaxing_vesicle --preset-accuracy fast --reduced-volume 0.7"
  "poiseuille_vesicle --confinement 0.9 --elements 32 --time 0.05 --frame-times 0,0.02,0.05 --vtk"
  "vesicle_through_constriction --profile pore --throat 0.8"
  "bodies_in_line --count 2 --distance 3 --bond 10 --time 0.2 --frames 9"
  "tether --time 1 --frame-times 0.5,1"
  "poiseuille_vesicle --method wall --wall-tolerance 1e-3 --confinement 0.5 --excess-area 0.6 --elements 24 --time 0.05"
  "settling_vesicle --discretization linear --stationary march --excess-area 1"
  "pearling --time 0.0045 --frame-times 0,0.0045"
  "bodies_in_line --count 2 --distance 4 --confinement 0.8 --capillary-number 20 --elements 24 --time 0.02"
  "bodies_in_line --count 2 --distance 4 --bond 5 --elements 32 --stationary newton"
  "settling_vesicle --integrator order3 --elements 24 --time 0.3 --checkpoint-every 7"
)

fail() {
  echo "FAILED: $*" >&2
  [[ -f $scratch/log ]] && cat "$scratch/log" >&2
  exit 1
}

# expect <exit code> <text> <command...>: how the command ends, and what it says.
expect() {
  local code=$1 text=$2 status=0
  shift 2
  "$@" >"$scratch/log" 2>&1 || status=$?
  [[ $status -eq $code ]] || fail "exit code $status instead of $code: $*"
  grep -q -- "$text" "$scratch/log" || fail "does not say '$text': $*"
}

same_results() {
  local file name
  diff <(ls "$1") <(ls "$2") || fail "other files in $2"
  for file in "$1"/*; do
    name=$(basename "$file")
    if [[ $name == summary.json ]]; then
      diff <(grep -v wall_seconds "$file") <(grep -v wall_seconds "$2/$name") || fail "$2/$name differs"
    else
      cmp "$file" "$2/$name" || fail "$2/$name differs"
    fi
  done
}

rm -rf "$scratch"
mkdir -p "$scratch"
kills=0
killed_at=()
for ((round = 0; round == 0 || kills < wanted; ++round)); do
  ((round < 100)) || fail "$kills kills in $round rounds"
  for number in "${!cases[@]}"; do
    read -r -a arguments <<<"${cases[number]}"
    name=${arguments[0]}
    if [[ ${#chosen[@]} -gt 0 && " ${chosen[*]} " != *" $name "* ]] || ((round > 0 && kills >= wanted)); then
      continue
    fi
    program=$programs/$name
    unharmed=$scratch/$number.unharmed
    if [[ ! -d $unharmed ]]; then
      begin=$(date +%s%N)
      expect 0 "" "$program" "${arguments[@]:1}" --out "$unharmed"
      seconds[number]=$(awk -v ns=$(($(date +%s%N) - begin)) 'BEGIN { print ns / 1e9 }')
      expect 2 "this one has, with the results" "$program" --resume "$unharmed"
    fi
    out=$scratch/$number.killed
    rm -rf "$out"
    now=("${arguments[@]:1}" --out "$out")
    here=0
    while true; do
      signal=${signals[kills % ${#signals[@]}]}
      limit=$(awk -v most="${seconds[number]}" -v r=$RANDOM 'BEGIN { print 0.8 * most * (r + 1) / 32768 }')
      ((kills < wanted)) || limit=3600
      status=0
      # The shell has something to say of its own about what is killed.
      { timeout --preserve-status -s "$signal" "$limit" "$program" "${now[@]}" >"$scratch/log" 2>&1; } 2>/dev/null ||
        status=$?
      [[ $status -eq 0 ]] && break
      case $signal.$status in
        KILL.137 | INT.130 | TERM.143 | HUP.129) ;; # the last two before the program could take notice
        TERM.130 | HUP.130)
          grep -q '"interrupted": true' "$out/summary.json" || fail "interrupted without results"
          [[ -f $out/run.journal ]] || fail "interrupted without a journal"
          ;;
        *) fail "exit code $status after SIG$signal: $name ${now[*]}" ;;
      esac
      kills=$((kills + 1))
      here=$((here + 1))
      if [[ -f $out/run.journal ]]; then
        now=(--resume "$out")
        expect 2 "must be absent with --resume" "$program" --resume "$out" --out "$out"
        for other in settling_vesicle relaxing_vesicle; do
          [[ $other == "$name" || ! -x $programs/$other ]] ||
            expect 2 "must be the directory of a run of $other" "$programs/$other" --resume "$out"
        done
      else
        expect 2 "there is no run.journal" "$program" --resume "$out"
      fi
    done
    same_results "$unharmed" "$out"
    echo "$here kills, same results: ${cases[number]}"
  done
done
echo "$kills kills"

# What cannot be written is said before the first step.
expect 2 "cannot be written: Not a directory" "$program" --out "$scratch/log/out"
expect 2 "cannot be written: File too large" bash -c 'trap "" XFSZ; ulimit -f 100; exec "$@"' bash "$program" \
  --out "$scratch/small"
[[ ! -f $scratch/small/summary.json && ! -f $scratch/small/run.journal ]] || fail "the program has begun"
