#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# robot_rate.sh BUILD [SECONDS] [HZ]: hallway-robot at HZ (200) for SECONDS (600) with slam_point and about 100 points in a frame: a simulated drive of
# maps/figure_eight.toml, a closed way of 3800 frames, replayed again and again. Prints deadlines missed, latencies, and the resident memory of the host and of the plugin's process
# every tenth of the time. Files go to BUILD/bench-out/robot_rate.
set -euo pipefail
build=$(realpath "$1")
seconds=${2:-600}
hz=${3:-200}
here=$(cd "$(dirname "$0")" && pwd)
out=$build/bench-out/robot_rate
rm -rf "$out"
mkdir -p "$out"
"$build/bin/hallway" run "$here/../maps/figure_eight.toml" --out "$out/drive" --quiet
points=$(awk -F, 'NR > 1 { ++n; last = $1 } END { printf "%.1f", n / (last + 1) }' "$out/drive/observations.csv")
echo "robot_rate: $hz Hz for $seconds s, $points points in a frame"
cat > "$out/robot.toml" <<TOML
[driver]
name = "replay"
log = "drive/run.mcap"
rate_hz = $hz
loop = true

[[plugin]]
name = "slam_point"
params = { noise_m = 0.05 }
TOML
"$build/bin/hallway-robot" run "$out/robot.toml" --out "$out/run" --duration "$seconds" &
robot=$!
resident_kib() { awk '/^VmRSS/ { print $2 }' "/proc/$1/status" 2>/dev/null || echo 0; }
sleep 1
for tenth in 1 2 3 4 5 6 7 8 9; do
  sleep "$(awk "BEGIN { print ($seconds - 1.5) / 9 }")"
  plugin=$(pgrep -P "$robot" | head -1 || true)
  echo "  at $tenth/9: host $(resident_kib "$robot") KiB, plugin $(resident_kib "${plugin:-0}") KiB"
done
wait "$robot"
