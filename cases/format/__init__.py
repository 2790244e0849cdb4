"""The format of case files: tables, rules, conversion to SI."""
