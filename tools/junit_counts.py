#!/usr/bin/env python3
"""Prints tests, failures and skips of a ctest JUnit file; a test that did not run counts as failed."""
import sys
import xml.etree.ElementTree as tree

cases = list(tree.parse(sys.argv[1]).getroot().iter("testcase"))
skipped = [c for c in cases if c.get("status") in ("notrun", "disabled") and c.find("skipped") is not None]
failed = [c for c in cases if c.get("status") != "run" and c not in skipped]
print(len(cases), len(failed), len(skipped))
