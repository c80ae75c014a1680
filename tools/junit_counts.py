#!/usr/bin/env python3
"""Prints tests, failures and skips of a ctest JUnit file. A test whose program is missing is a failure, not a skip."""
import sys
import xml.etree.ElementTree as tree


def skipped(case):
    reason = case.find("skipped")
    return reason is not None and reason.get("message", "").startswith("SKIP_")


cases = list(tree.parse(sys.argv[1]).getroot().iter("testcase"))
skips = [case for case in cases if skipped(case)]
failures = [case for case in cases if case.get("status") != "run" and not skipped(case)]
print(len(cases), len(failures), len(skips))
