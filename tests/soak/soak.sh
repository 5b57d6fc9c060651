#!/usr/bin/env bash
# Long runs at 30 Hz: memory must stay flat, no frame may be lost by the tracker. ./dev soak [MINUTES]
set -euo pipefail
minutes=${1:-10}
armsreach=${2:?soak.sh MINUTES PROGRAM}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
frames=$((minutes * 60 * 30))
failed=0

resident_kb() { awk '/VmRSS/ {print $2}' "/proc/$1/status" 2>/dev/null || true; }

soak() {  # soak SOURCE
  echo "soak: $1 for $minutes minutes"
  "$armsreach" run --source "$1" --display egl --frames "$frames" --stats "$folder/stats.json" \
    --events "$folder/events.jsonl" >"$folder/log" 2>&1 &
  local pid=$! samples=()
  while sleep 5 && kill -0 "$pid" 2>/dev/null; do
    samples+=("$(resident_kb "$pid")")
  done
  wait "$pid" || { cat "$folder/log"; failed=1; return; }
  # The first third fills the map and the allocator's arenas; from there on memory must be flat.
  if [ ${#samples[@]} -lt 6 ]; then echo "soak: too short to judge"; failed=1; return; fi
  local warm=${samples[$((${#samples[@]} / 3))]} last=${samples[-2]}
  local rate
  rate=$(awk -F'[:,]' '/"rate"/ {printf "%.0f", $2}' "$folder/stats.json")
  local lost
  lost=$(grep -c '"state":"lost"' "$folder/events.jsonl" || true)
  cat "$folder/log"
  echo "soak: $((warm / 1024)) MB after a third, $((last / 1024)) MB at the end, lost $lost times"
  if [ $((last * 100)) -gt $((warm * 105)) ]; then echo "soak: FAILED: memory grows"; failed=1; fi
  if [ "$rate" -lt 29 ]; then echo "soak: FAILED: $rate frames a second, on a machine with nothing else to do 30"; failed=1; fi
  if [ "$lost" -ne 0 ]; then echo "soak: FAILED: the camera was lost"; failed=1; fi
}

soak sim:bench,loop=endless
if [ -d "${ARMSREACH_DATA:-}/rgbd/redkitchen" ]; then
  soak "tum:$ARMSREACH_DATA/rgbd/redkitchen,loop=pingpong"
else
  echo "soak: no recording: ARMSREACH_DATA names no folder with rgbd/redkitchen"
fi
exit $failed
