// SPDX-License-Identifier: Apache-2.0
// Runs one of Whorl's programs and measures it.
#pragma once

#include <string>
#include <vector>

namespace whorl::testing {

struct RunResult {
    int status = -1;  ///< exit status; -1 when a signal ended it
    int signal = 0;
    double seconds = 0.0;
    double peakMegabytes = 0.0;  ///< of the program or of a child that it waited for, whichever was larger
    std::string out;
    std::string err;
};

/// `program` is looked up in $WHORL_BIN. Standard input is empty. Killed after `timeoutSeconds` (signal 9).
RunResult run(const std::string& program, const std::vector<std::string>& arguments, double timeoutSeconds = 120.0);

}  // namespace whorl::testing
