local h = history.file{ file = "decimals_or_columns.csv" }
