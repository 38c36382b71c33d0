/* Why a text is not YAML, for people. */
#ifndef MONGE_LANG_PROBLEM_H
#define MONGE_LANG_PROBLEM_H

#include "lang/node.h"

/* Reports the problem that node_parse has found: what is wrong, and the smallest fix. */
void problem_report(struct diagnostics *diag, const struct node_problem *problem);

#endif
