#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
set -euo pipefail
usage() {
  cat <<'HELP'
usage: same_bytes.sh BEFORE AFTER [--only REGEX] [--keep DIR] [--list]

Runs the same commands with two builds and compares, byte by byte, what they print, their exit status and every file
that they write. It shows that a change of the code changed no result.

  BEFORE       the build from before: its folder (build/release of another clone), or a folder that --keep left
  AFTER        the build to check: its folder
  --only REGEX compare the cases whose names match (grep -E)
  --keep DIR   leave in DIR what BEFORE gave, for later comparisons
  --list       print the cases and their commands, run nothing

The maps are those of this tree. Facts of the clock and the machine do not count: timing.csv, times*.csv, `host`, and
numbers of seconds, milliseconds and bytes of memory. Nor do facts of the build: its folder, and the hashes of plugins'
files. The two builds must be of the same processor's family.
Exit status: 0 all is the same; 1 something differs, its first lines are shown; 2 usage.
HELP
}

here=$(cd "$(dirname "$0")" && pwd)
data=${HALLWAY_DATA:-$here/../../../shared/data}
only=. keep= list=false folders=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --only) only=${2:?--only takes a regular expression} && shift 2 ;;
    --keep) keep=${2:?--keep takes a folder} && shift 2 ;;
    --list) list=true && shift ;;
    -h | --help) usage && exit 0 ;;
    -*) usage >&2 && exit 2 ;;
    *) folders+=("$1") && shift ;;
  esac
done

# A case is a name and a line of the shell. It starts in an empty folder, beside which `maps` is; `hallway` and `hallway-robot` are the build's.
cases=()
case_() { cases+=("$1"$'\t'"$2"); }
scenario() { case_ "run_$1" "hallway run ../maps/$1.toml --quiet --out out ${2:-}"; }

# Every scenario of maps/: of points, walls, faces and clouds; the picture layers of each.
scenario figure_eight
scenario office
scenario flat
scenario straight_line
scenario stationary "--steps 1500"
scenario four_planes
scenario hallway
scenario hallway_return
scenario key_points
scenario loop_corridor
scenario motion_model
scenario bad_pairs
scenario pseudo_merge
scenario roll_back "--steps 1200"
scenario many_planes "--steps 1500"
scenario spatial_rooms
scenario em_corridor "--steps 150"
scenario em_floor "--steps 150"
# Other ways of the same algorithms, noise, movers, processes and threads.
case_ run_thesis_points "hallway run ../maps/figure_eight.toml --quiet --steps 800 --plugin slam_point:mode=thesis --out out"
case_ run_moving "hallway run ../maps/figure_eight.toml --quiet --steps 800 --set cloud.around_the_path.per_100m=25 --set cloud.around_the_path.moving_share=0.2 --out out"
case_ run_walls_noise "hallway run ../maps/loop_corridor.toml --quiet --steps 900 --seed 5 --set sensor.eyes.noise_m=0.02 --set sensor.eyes.noise_angle_deg=0.3 --set sensor.eyes.noise_end_m=0.005 --out out"
case_ run_walls_thesis "hallway run ../maps/four_planes.toml --quiet --steps 500 --plugin slam_plane:mode=thesis --out out"
case_ run_faces_noise "hallway run ../maps/spatial_rooms.toml --quiet --steps 500 --seed 3 --set sensor.eyes.noise_m=0.02 --set sensor.eyes.noise_angle_deg=0.3 --out out"
case_ run_in_process "hallway run ../maps/office.toml --quiet --steps 300 --seed 9 --in-process --threads 2 --out out"
case_ run_bare_map "hallway run ../maps/office.map --quiet --steps 120 --foxglove --out out"
case_ run_small_map "hallway run ../maps/regress/sealed_room.map --quiet --steps 40 --out out"
# What was recorded.
case_ replay_csv "hallway run ../maps/office.toml --quiet --steps 250 --out a && hallway replay a/observations.csv --quiet --out b"
case_ replay_mcap "hallway run ../maps/hallway.toml --quiet --steps 250 --out a && hallway replay a/run.mcap --quiet --out b"
case_ replay_log "hallway replay $data/landmark_logs/figure8_d25/obs.csv --plugin slam_point --quiet --out out"
case_ replay_3d "hallway replay $data/landmark_logs/figure8_3d_d25/obs.csv --plugin slam_point --steps 1500 --quiet --out out"
case_ replay_kitti "hallway replay $data/landmarks/kitti_0022_obs3d.csv --plugin slam_point:noise_m=0.2 --steps 150 --quiet --out out"
case_ score "hallway run ../maps/office.toml --quiet --steps 200 --out a && hallway score a/truth.tum a/trajectory.tum --json"
case_ log_commands "hallway run ../maps/bad_pairs.toml --quiet --steps 120 --out a && hallway log info a/run.mcap --json && hallway log cut a/run.mcap --out cut.mcap --from-iteration 10 --to-iteration 60 ; hallway log convert a/run.mcap --out csv && hallway log convert a/run.mcap --foxglove --out fox.mcap && hallway log recover a/run.mcap --out again.mcap"
case_ log_victoria "hallway log convert $data/victoria_park --out park.mcap && hallway log info park.mcap"
case_ robot "hallway run ../maps/office.toml --quiet --steps 60 --out a && printf 'schema = \"hallway.robot/1\"\n[driver]\nname = \"replay\"\nlog = \"a/run.mcap\"\n[[plugin]]\nname = \"slam_point\"\n' >robot.toml; hallway-robot check robot.toml; hallway-robot run robot.toml --out out --quiet"
# Planes in clouds, registration.
case_ planes_scene "hallway planes $data/em_scenes/scene_00.csv --plugin em --quiet --out out && hallway planes $data/em_scenes/scene_05.csv --plugin em --json"
case_ planes_modes "for p in em em1 em2; do hallway planes $data/em_scenes/scene_07.csv --plugin \$p --json; done"
case_ planes_room "hallway planes $data/clouds/kinect_table_learn0.pcd --plugin em --quiet --out out"
case_ bench_em "hallway bench-em --plugin em --scenes 4 --points 300..4000 --seed 3 --quiet --out out"
case_ align "hallway align $data/clouds/room_scan1.pcd $data/clouds/room_scan2.pcd --guess '1.8 0.7 0 40 0 0' --out moved.ply --json"
# Studies, comparisons, batches.
case_ study_density "hallway study density --quick --seeds 1 --steps 150 --quiet --out out"
case_ study_straight "hallway study straight --quick --seeds 1 --steps 200 --quiet --out out"
case_ compare "hallway compare ../maps/office.toml --steps 120 --plugin slam_point:noise_m=0.01,0.02 --quiet --out out"
case_ batch "printf 'schema = \"hallway.batch/1\"\nscenarios = [\"../maps/four_planes.toml\"]\nseeds = [1, 2]\nsteps = 120\n' >plan.toml; hallway batch plan.toml --quiet --out out"
# Maps: compiling, checking, drawing, editing.
case_ compile_maps "for m in ../maps/*.map; do hallway compile \$m --json; hallway map check \$m; hallway map info \$m --json; done"
case_ compile_regress "for m in ../maps/regress/*.map; do hallway compile \$m --json; hallway map leak \$m --json; done 2>&1"
case_ compile_e1m1 "cp $data/maps/id1/e1m1.map . && hallway compile e1m1.map --json && hallway map export e1m1.map --out e1m1.ply"
case_ map_queries "hallway map ray ../maps/office.map 2,3,1.5 9,3,1.5 --json; hallway map pvs ../maps/office.map 2,3,1.5 9,9,1.5 --json; hallway map export ../maps/office.map --out office.glb; hallway map export ../maps/office.map --points --out points.ply; cp ../maps/models/knot.glb . && hallway import knot.glb --out model.map"
case_ render "hallway render ../maps/office.map --show pvs-from=2,3,1.5,portals --out top.png && hallway render ../maps/flat.map --view perspective --out view.png"
case_ edit_scripts "cp -r ../maps/models . && for s in ../maps/*.hwe; do n=\$(basename \$s .hwe); hallway edit \$n.map -f \$s --json; hallway edit \$n.map undo; hallway edit \$n.map log; hallway edit \$n.map history save \$n.hwe; hallway edit \$n.map validate; hallway edit \$n.map list; done"
case_ edit_plan "hallway edit flat.map -f ../maps/flat.hwe && hallway edit flat.map print plan.svg paper=a1; hallway edit flat.map print plan.pdf paper=a1; hallway edit --reference"
case_ edit_commands "e() { hallway edit a.map \"\$@\"; }; e new; e room from 0,0 to 5,4 height=2.5 wall=0.2 floor_material=wood name=kitchen; e door in kitchen side=east at 2 width 0.9 leaf=wood open=60; e window in kitchen side=north at 1; e box 1,1,0 2,2,1 name=crate; e hollow crate thickness 2cm; e cylinder at 3,3,0 radius=0.3 height=2 name=pillar; e clip pillar axis=z at=1 keep=both; e array crate linear 2 by 1.5,0; e rotate crate by 30 about 1,1; e mirror crate x at 2; e scale crate 2; e subtract crate; e material kitchen brick; e start 1,2; e path 1,2 3,2 4,3 name=way; e path 1,2 3,2 name=way; e landmarks path=way per_100m=20; e landmarks per_m2=2; e remake kitchen height=3; e undo to=2; e print kitchen.svg; e export a.obj; e compile; e validate; e log; e undo; e redo; e diff; e save; e info kitchen; e measure 0,0 3,4; e measure crate; e room 1; e nonsense; e door in nowhere at 2; cat a.map a.map.journal"
case_ help_texts "for c in '' run replay serve score compare batch study log render plugin driver planes bench-em scenario import align compile map edit doctor help completion man; do hallway \$c --help; hallway help \$c; done; hallway man run; hallway completion bash; hallway-robot --help"
case_ plugins "hallway plugin list --json; for p in slam_point slam_plane em icp; do hallway plugin info \$p; hallway plugin check \$(dirname \$(dirname \$(command -v hallway)))/lib/hallway/plugins/\$p.so; done; hallway plugin new mine; hallway driver new mydriver"
case_ bad_inputs "for f in nofile.toml ../maps/README.md; do hallway run \$f; hallway compile \$f; hallway replay \$f --plugin slam_point; hallway score \$f \$f; hallway planes \$f --plugin em; done; hallway run ../maps/office.toml --set nonsense=1; hallway run ../maps/office.toml --plugin nothing; hallway frobnicate; echo 'a,b' >t.csv; hallway replay t.csv --plugin slam_point"

if $list; then printf '%s\n' "${cases[@]}" | grep -E "^[^	]*($only)[^	]*	" && exit 0; exit 2; fi
[[ ${#folders[@]} -eq 2 ]] || { usage >&2; exit 2; }
before=$(realpath "${folders[0]}") after=$(realpath "${folders[1]}")
for build in "$before" "$after"; do
  [[ -x $build/bin/hallway || ( $build == "$before" && -e $build/same_bytes ) ]] ||
    { echo "same_bytes: $build has no bin/hallway" >&2; exit 2; }
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# perform BUILD ROOM CASE LINE: leaves the files of the case in ROOM/CASE. The paths in what is printed are the same for both builds.
perform() {
  mkdir -p "$2/$3"
  rm -rf "$2/maps"
  cp -r "$here/../../maps" "$2/maps"
  find "$2/maps" -name .hallway -prune -exec rm -rf {} +
  local status=0
  (cd "$2/$3" && PATH="$1/bin:$PATH" HOME="$2" XDG_CACHE_HOME="$2/cache" HALLWAY_DATA="$data" TZ=UTC \
    bash -c "$4" >.out 2>.err </dev/null) || status=$?
  echo "$status" >"$2/$3/.status"
  { grep -rlIF -e "$1" -e "$2" "$2/$3" || true; } | tr '\n' '\0' | xargs -0r sed -i -e "s|$1|BUILD|g" -e "s|$2|ROOM|g"
  rm -rf "$2/maps"
}

differing=0 same=0
for entry in "${cases[@]}"; do
  name=${entry%%$'\t'*} line=${entry#*$'\t'}
  grep -qE "$only" <<<"$name" || continue
  if [[ -e $before/same_bytes ]]; then
    mkdir -p "$work/before" && cp -r "$before/$name" "$work/before/"
  else
    perform "$before" "$work/room" "$name" "$line" && mkdir -p "$work/before" && mv "$work/room/$name" "$work/before/"
  fi
  perform "$after" "$work/room" "$name" "$line" && mkdir -p "$work/after" && mv "$work/room/$name" "$work/after/"
  if python3 -B "$here/same_bytes.py" "$work/before/$name" "$work/after/$name"; then
    same=$((same + 1))
  else
    differing=$((differing + 1))
  fi
  if [[ -n $keep ]]; then mkdir -p "$keep" && touch "$keep/same_bytes" && rm -rf "${keep:?}/$name" && mv "$work/before/$name" "$keep/"; fi
  rm -rf "$work/before" "$work/after"
done
echo "same_bytes: $same cases the same, $differing differ"
[[ $((same + differing)) -gt 0 ]] || { echo "same_bytes: no case matches '$only'" >&2; exit 2; }
[[ $differing -eq 0 ]]
