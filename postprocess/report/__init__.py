"""Documents made of a result folder: HTML page, PDF, workbook.

batch            - parts of the page of a batch
bearing          - parts of the page of a bearing or a single contact
html             - values as text of HTML, and the templates that hold the markup
page             - the page: which parts it has, warnings, notes
pdf_and_workbook - A result folder as pages of a PDF, and as a workbook for spreadsheet programs
simulations      - parts of the page on a time simulation and on vibration
"""
