# SPDX-License-Identifier: MIT
# Toolchain file for 64-bit ARM with Debian's cross compiler and libraries of arm64 beside those of this machine (dpkg --add-architecture arm64,
# scripts/install-deps.sh cross-arm64): cmake -S . -B build/arm64 --toolchain cmake/aarch64-linux-gnu.cmake. Programs that run while building, such as
# protoc, are this machine's; with qemu-user what was built runs, too.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(ENV{PKG_CONFIG_LIBDIR} /usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig)

find_program(HALLWAY_QEMU NAMES qemu-aarch64 qemu-aarch64-static)
mark_as_advanced(HALLWAY_QEMU)
if(HALLWAY_QEMU)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${HALLWAY_QEMU})
endif()
