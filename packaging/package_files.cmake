# SPDX-License-Identifier: MIT
# Runs when a package is made, after all else has been installed for it: the changelog of `package`, and everything compressed that Debian wants compressed.
# The date is that of SOURCE_DATE_EPOCH where it is set.
set(share "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/share")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(MAKE_DIRECTORY "${share}/doc/${package}")
execute_process(COMMAND "${source}/packaging/changelog.sh" "${package}" "${version}" "${maintainer}" "${date}"
                INPUT_FILE "${source}/CHANGELOG.md" OUTPUT_FILE "${share}/doc/${package}/changelog" COMMAND_ERROR_IS_FATAL ANY)
file(GLOB pages "${share}/man/man*/*.[1-8]")
execute_process(COMMAND gzip -9nf "${share}/doc/${package}/changelog" ${pages} COMMAND_ERROR_IS_FATAL ANY)
