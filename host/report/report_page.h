// `quasilux report`: one page that needs nothing besides itself, to read on a screen and on paper.
#pragma once

#include "report/report_content.h"

namespace quasilux {

std::string reportPage(const ReportContent& content);

} // namespace quasilux
