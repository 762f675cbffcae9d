local h = history.file{ file = "broken.csv" }
