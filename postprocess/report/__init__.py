"""Documents made of a result folder: HTML page, PDF, workbook.

page     - the page: which parts it has, warnings, notes
bearing  - parts of the page of a bearing or a single contact
cards    - the numbers that are looked at first
torque   - part of the page on the friction torque
vibration - part of the page on vibration
dynamics - part of the page on a time simulation
batch    - parts of the page of a batch
html     - values as text of HTML, and the templates that hold the markup
plots_pdf    - the numbers and pictures of a result folder as pages of a PDF
spreadsheet  - all numbers of a result folder as one workbook
"""
