int passo_placeholder;
