local h = history.file{ file = "pyroshock.csv" }
