# SPDX-License-Identifier: MIT
"""Copies the ABI's headers as a later minor version might have them: every struct that may grow has grown at its end.

usage: grow_headers.py INCLUDE_FOLDER OUTPUT_FOLDER
"""

import pathlib
import re
import sys

GROWABLE = re.compile(r"(typedef struct (\w+) \{\n  uint32_t size;.*?)(\n\} \2;)", re.DOTALL)
NEW_MEMBERS = "\n  double grown_number;\n  const void* grown_pointer;\n  uint64_t grown_counts[3];"


def main() -> None:
    source, target = map(pathlib.Path, sys.argv[1:])
    grown = []
    for path in sorted(source.rglob("*.h*")):
        text = path.read_text()
        grown += [match.group(2) for match in GROWABLE.finditer(text)]
        text = GROWABLE.sub(lambda match: match.group(1) + NEW_MEMBERS + match.group(3), text)
        if path.name == "version.h":
            text = re.sub(r"(#define HW_ABI_MINOR )(\d+)u", r"\g<1>1000u\n#define HW_TEST_GROWN 1", text)
        output = target / path.relative_to(source)
        output.parent.mkdir(parents=True, exist_ok=True)
        if not output.exists() or output.read_text() != text:
            output.write_text(text)
    for needed in ("hw_sample_t", "hw_sensor_info_t", "hw_output_t", "hw_error_t", "hw_host_t", "hw_param_info_t",
                   "hw_activation_t", "hw_drive_info_t", "hw_body_info_t", "hw_encoder_info_t", "hw_bump_info_t",
                   "hw_range_scan_t", "hw_range_scan_info_t", "hw_odometry_t", "hw_imu_t", "hw_imu_info_t",
                   "hw_gnss_t", "hw_gnss_info_t", "hw_magnetic_t", "hw_topology_t", "hw_drawing_t"):
        if needed not in grown:
            sys.exit(f"{needed} has not grown: is its first member still `uint32_t size;`?")


main()
