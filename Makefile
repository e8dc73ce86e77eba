# SPDX-License-Identifier: MIT
# The two commands to know: `make demo` and `make test`. JOBS=N sets how many compilers run at once.
JOBS ?= $(shell nproc)
HALLWAY := build/release/bin/hallway

.PHONY: demo programs install uninstall package test-package test test-long check fuzz bench bench-peers renders format lint clean build-release deps deps-ros
.DEFAULT_GOAL := demo

## deps-demo, deps-test, deps-check, …: the packages that a command needs
deps: deps-test
deps-%:
	@scripts/install-deps.sh $*

## also the packages of ROS 1, for the driver ros1
deps-ros:
	@scripts/install-deps.sh test --with-ros

build-release: deps-test
	cmake --preset release
	cmake --build --preset release -j $(JOBS)

## packages, build of what the demonstration runs, the two runs, their pictures and tables
demo: deps-demo
	cmake --preset release
	cmake --build --preset release -j $(JOBS) --target demo
	scripts/demo.sh $(HALLWAY)

## packages, release build, every test that is not labelled `long`
test: build-release
	ctest --preset release --no-tests=error

## the programs, the plugins, the SDK, maps and documents, into $(DESTDIR)$(PREFIX); what is installed is built, and no test
PREFIX ?= /usr/local
# zsh leaves `PREFIX=~/.local` as it is written.
override PREFIX := $(patsubst ~/%,$(HOME)/%,$(PREFIX))
install: programs
	DESTDIR="$(DESTDIR)" cmake --install build/release --prefix "$(PREFIX)"

programs: deps-package
	cmake --preset release
	cmake --build --preset release -j $(JOBS) --target programs

## takes away what `make install` with the same DESTDIR and PREFIX left
uninstall:
	@scripts/uninstall.sh "$(DESTDIR)$(PREFIX)"

## Debian packages into build/package: hallway, hallway-robot, hallway-dev
package: programs
	scripts/package.sh build/release build/package

## builds the packages, and installs, uses and purges them in a chroot of a bare Debian
test-package: programs
	tests/package/debian_test.sh build/release

## every test, at full size
test-long: build-release
	ctest --test-dir build/release --output-on-failure --no-tests=error

## g++, clang, address+undefined and thread sanitizers: build and tests of each; the benchmarks are built once
check: deps-check
	for preset in release clang asan tsan; do \
	  cmake --preset $$preset && cmake --build --preset $$preset -j $(JOBS) && ctest --preset $$preset || exit 1; \
	done
	cmake --build --preset clang -j $(JOBS) --target benches

## libFuzzer on everything that reads foreign bytes, FUZZ_SECONDS each; what it finds is kept in build/fuzz/finds
FUZZ_SECONDS ?= 600
FUZZ_TARGETS := map_reader mesh_protocol mesh_scene edit_command edit_journal mcap_reader udp_datagrams frame_bytes cloud_reader landmark_tables kitti_odometry euroc pcd_imu_folder drive_commands robot_reader
fuzz: deps-fuzz
	cmake -S . -B build/fuzz -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang \
	  -DHALLWAY_FUZZ=ON -DHALLWAY_SANITIZE=address,undefined,fuzzer-no-link -DHALLWAY_BENCH=OFF
	cmake --build build/fuzz -j $(JOBS) --target $(FUZZ_TARGETS:%=fuzz_%)
	for target in $(FUZZ_TARGETS); do \
	  mkdir -p build/fuzz/finds/$$target && build/fuzz/tests/fuzz_$$target -max_total_time=$(FUZZ_SECONDS) -timeout=20 \
	    -artifact_prefix=build/fuzz/finds/$$target/ build/fuzz/finds/$$target tests/fuzz/corpus/$$target || exit 1; \
	done

## benchmarks: ratios against references measured in the same run, and a plot
bench: deps-bench build-release
	cmake --build --preset release -j $(JOBS) --target benches
	bench/run.sh build/release

## em beside PCL, CGAL and Open3D on the same clouds, slam_point beside MRPT and batch maximum likelihood on the same logs: installs and builds them, in a folder of its own
bench-peers:
	@scripts/install-deps.sh bench --with-peers
	cmake -S . -B build/peers -G Ninja -DCMAKE_BUILD_TYPE=Release -DHALLWAY_PEERS=ON -DHALLWAY_TESTS=OFF -DHALLWAY_BENCH=OFF
	cmake --build build/peers -j $(JOBS) --target hallway em slam_point peers slam_peers
	bench/peers/run.sh build/peers
	python3 bench/peers/slam/table.py build/peers build/peers/bench-out/slam

## make the gallery's pictures again
renders: build-release
	renders/make.sh $(HALLWAY)

format: deps-format
	git ls-files '*.cpp' '*.hpp' '*.h' '*.c' | xargs clang-format -i

lint: deps-lint
	cmake --preset clang
	git ls-files 'engine/*.cpp' 'cli/*.cpp' 'plugins/*.cpp' | xargs -P $(JOBS) -n 4 clang-tidy -p build/clang --quiet

clean:
	rm -rf build out
