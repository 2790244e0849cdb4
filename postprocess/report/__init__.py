"""The HTML report of a result folder.

page     - the page: which parts it has, warnings, notes
bearing  - parts of the page of a bearing or a single contact
batch    - parts of the page of a batch
html     - tables, facts, pictures and numbers as HTML
svg      - bar charts as SVG
"""
