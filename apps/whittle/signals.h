// What the program does when the system interrupts it.
#pragma once

namespace whittle {

/// To be called first of all. Interruptions (SIGINT, SIGTERM, SIGHUP) end the programs that it has
/// started, remove the files that are not complete, and then end it as they would have. Writing to
/// a closed pipe, or beyond a file size limit, becomes an error like any other. The three standard
/// files are there: where one is missing, no file of ours can take its place.
void prepare_for_interruption();

}  // namespace whittle
