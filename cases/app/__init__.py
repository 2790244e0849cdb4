"""The live program `oilfilm app`: a page whose numbers, films and maps follow its controls.

The server knows the designs and the page; what computes runs in worker processes.

design   - the text of a case: history, address, changes key by key
controls - keys of a case with their range, unit and source
readings - what pages say of a summary
pictures - small pictures as SVG
engine   - points, contacts and documents, in worker processes
workers  - worker processes, and points of maps in a readable order
session  - the one state behind the page
server   - the server, its token and its end
"""
