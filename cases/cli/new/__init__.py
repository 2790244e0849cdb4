"""Text of new case files.

case_text       - a case of a bearing by its designation or its boundary dimensions
first_operation - speed, loads, oil and cooling that it starts from
"""
